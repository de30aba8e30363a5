// How large the tiles are that threads take.
#pragma once

#include <cstddef>

#include "engine/plan/choice.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// The largest tile that others, whose turn comes after it, may be made to wait for: by the rays
/// of `samples` per pixel, each one from the eye and `light_rays` to lights. A multiple of the
/// kernel's blocks.
int interruptible_side_px(int samples, std::size_t light_rays);

/// Whether a pass of so many samples per pixel takes so few rays, reflected ones included, that
/// whoever asks for it traces it, as one tile: two spheres at 64 x 48 take 5 us here and 14 us on
/// the pool's threads, which have to wake up.
bool is_one_tile(const Scene& scene, int samples);

/// Of a render's first pass, which takes so many samples per pixel: interruptible, and as large as
/// leaves each thread enough tiles to share the work evenly, because a tile costs a lock.
Choice<int> choose_tile_side(const Scene& scene, int samples, std::size_t thread_count);

}  // namespace raytracer
