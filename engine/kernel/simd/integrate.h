// The SIMD kernels' third entry: colours integrated along lines between the edges that cross them,
// for blocks and for single pixels.
//
// What it costs is by the edges that a pixel shows, not by its samples: where these err as n^-3/4,
// lines do as n^-3/2.
#pragma once

#include <cstdint>
#include <span>

#include "engine/image/image.h"
#include "engine/image/pixel_spreads.h"
#include "engine/image/sampled_pixel.h"
#include "engine/image/tile.h"
#include "engine/kernel/beyond_range.h"
#include "engine/kernel/line_pattern.h"
#include "engine/kernel/simd/simd_scene.h"

namespace raytracer {

/// What came of a block.
struct IntegratedBlock {
  /// The parts, as Tile::parts, of which nothing was stored, because lines do not find all of their
  /// edges: they show many spheres, some that intersect, one that the eye is too near to, the
  /// shadow of a square on something else, or colours several times too bright to be shown.
  std::uint16_t left = 0;
  BeyondRange beyond{};  ///< of what was stored
};

/// Integrates all pixels of a tile that is a block or, at the image's rim, what there is of one;
/// stores their colours after `transfer`, and what the lines tell of their errors. The scene is
/// one of those that choose_integration() chooses lines for.
IntegratedBlock integrate_block(const SimdScene<float>& scene, const LinePattern& pattern,
                                Transfer transfer, const Tile& block, std::int64_t target,
                                Image& image, PixelSpreads& spreads);
IntegratedBlock integrate_block(const SimdScene<double>& scene, const LinePattern& pattern,
                                Transfer transfer, const Tile& block, std::int64_t target,
                                Image& image, PixelSpreads& spreads);

/// Integrates pixels of a block, part by part, none in a part that was left, and leaves what they
/// come to in `results`, one for each. Those of a part are looked at finely if one of them is
/// clamped, as in a block.
void integrate_pixels(const SimdScene<float>& scene, const LinePattern& pattern, Transfer transfer,
                      const BlockPixels& pixels, std::int64_t target,
                      std::span<SampledPixel> results);
void integrate_pixels(const SimdScene<double>& scene, const LinePattern& pattern, Transfer transfer,
                      const BlockPixels& pixels, std::int64_t target,
                      std::span<SampledPixel> results);

}  // namespace raytracer
