// How large the tiles are that threads take.
#pragma once

#include <cstddef>

#include "engine/plan/choice.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// As large as leaves each thread enough tiles to share the work evenly, because a tile costs a
/// lock; but no more samples than others, whose turn comes after a tile, may be made to wait for.
/// `samples` are those of one pass, per pixel.
int tile_side_px(int width, int height, int samples, std::size_t thread_count);

/// Of a render's first pass, which under a contract has one sample per pixel.
Choice<int> choose_tile_side(const Camera& camera, const RenderSettings& settings,
                             std::size_t thread_count);

}  // namespace raytracer
