// How far the pixels of an image probably are from what endless samples would make of them.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/image/pixel_spreads.h"
#include "engine/math/block.h"

namespace raytracer {

/// For each subtile of each block the sum of the squared errors of its values, estimated from the
/// samples alone: of half buffers A and B, spread alike, as if their errors were independent
/// (SampleErrorModel::half_difference_share). They complete each other and err less together, which
/// an error multiplier corrects (PixelErrors).
///
/// Limits: what no sample met is in no estimate.
class SubtileErrors {
 public:
  /// Zeros, for an image of this size in pixels.
  SubtileErrors(int width, int height)
      : columns_(blocks_along(width)),
        error2_(subtiles_in_block * columns_ * blocks_along(height), 0.0) {}

  /// The subtiles of the block that begins at pixel (x, y), row by row.
  double* of_block(int x, int y) {
    return error2_.data() + subtiles_in_block * block_index(x, y, columns_);
  }

  /// Of all subtiles, a block's one after another, the blocks row by row.
  const std::vector<double>& all() const { return error2_; }

 private:
  std::size_t columns_;
  std::vector<double> error2_;
};

/// Where a tile's samples tell its errors: what somebody wants.
struct TileErrors {
  SubtileErrors* subtiles = nullptr;
  PixelSpreads* pixels = nullptr;

  bool are_wanted() const { return subtiles != nullptr || pixels != nullptr; }
};

}  // namespace raytracer
