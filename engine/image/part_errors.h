// How far the pixels of an image probably are from what endless samples would make of them.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/image/pixel_spreads.h"
#include "engine/math/block.h"

namespace raytracer {

/// For each part of each block the sum of the squared errors of its values, estimated from the
/// samples alone: two halves of them, spread alike, differ by what both err. If they err like
/// random ones, all together err by half of the halves' difference. Halves that complete each other
/// err less together (PixelErrors).
///
/// Limits: what no sample met is in no estimate.
class PartErrors {
 public:
  /// Of the halves' squared difference.
  static constexpr double share = 0.25;

  /// Zeros, for an image of this size in pixels.
  PartErrors(int width, int height)
      : columns_(blocks_along(width)),
        error2_(parts_in_block * columns_ * blocks_along(height), 0.0) {}

  /// The parts of the block that begins at pixel (x, y), row by row.
  double* of_block(int x, int y) {
    const auto column = static_cast<std::size_t>(x / block_side);
    const auto row = static_cast<std::size_t>(y / block_side);
    return error2_.data() + parts_in_block * (row * columns_ + column);
  }

  /// Of all parts, a block's one after another, the blocks row by row.
  const std::vector<double>& all() const { return error2_; }

 private:
  static std::size_t blocks_along(int pixels) {
    return static_cast<std::size_t>((pixels + block_side - 1) / block_side);
  }

  std::size_t columns_;
  std::vector<double> error2_;
};

/// Where a tile's samples tell its errors: what somebody wants.
struct TileErrors {
  PartErrors* parts = nullptr;
  PixelSpreads* pixels = nullptr;

  bool are_wanted() const { return parts != nullptr || pixels != nullptr; }
};

}  // namespace raytracer
