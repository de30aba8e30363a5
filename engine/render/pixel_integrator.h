// An image's pixels integrated along lines; by samples in the parts where that cannot be done.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/image/image.h"
#include "engine/image/pixel_spreads.h"
#include "engine/image/sampled_pixel.h"
#include "engine/image/tile.h"
#include "engine/kernel/beyond_range.h"
#include "engine/render/tracer.h"

namespace raytracer {

/// Asked for so many samples, it draws as many lines as their root: they err about as much, or
/// less, and their errors fall alike. All pixels of a block are integrated before single ones.
class PixelIntegrator {
 public:
  PixelIntegrator(const Tracer& tracer, Transfer transfer, std::size_t block_count)
      : tracer_(tracer), transfer_(transfer), left_(block_count, 0) {}

  /// All pixels of the block with this number and tile, into `image` and `spreads`. Threads may do
  /// several at once.
  BeyondRange integrate(std::size_t block, const Tile& tile, int samples, Image& image,
                        PixelSpreads& spreads);

  /// Some of a block's pixels, part by part; `results` has one for each.
  void integrate(std::size_t block, int samples, const BlockPixels& pixels,
                 std::span<SampledPixel> results) const;

 private:
  const Tracer& tracer_;
  Transfer transfer_;
  std::vector<std::uint16_t> left_;  ///< of each block: the parts that lines cannot do
};

}  // namespace raytracer
