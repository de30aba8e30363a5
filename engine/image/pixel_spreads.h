// What the samples of each pixel tell of its error: how their half buffers differ, and how they
// vary.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/math/block.h"

namespace raytracer {

/// What a pixel's samples tell of its error in linear light; nothing, zeros, if they are no
/// numbers.
struct PixelSpread {
  float error2 = 0;    ///< by its half buffers alone, as SubtileErrors says
  float variance = 0;  ///< of its samples, the sum over the channels, at least `error2`
};

/// The same of all pixels of an image, row by row, the rows and columns filled up to whole subtiles
/// by pixels that tell nothing.
struct PixelSpreads {
  int stride;  ///< from row to row, a multiple of subtile_side
  std::vector<float> error2;
  std::vector<float> variance;

  PixelSpreads(int width, int height)
      : stride(whole_subtiles(width)),
        error2(count(width, height)),
        variance(count(width, height)) {}

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(stride) +
           static_cast<std::size_t>(x);
  }
  void set(std::size_t pixel, const PixelSpread& spread) {
    error2[pixel] = spread.error2;
    variance[pixel] = spread.variance;
  }

  int rows() const { return static_cast<int>(error2.size() / static_cast<std::size_t>(stride)); }

  /// Filled up.
  static int whole_subtiles(int pixels) {
    return (pixels + subtile_side - 1) / subtile_side * subtile_side;
  }

 private:
  static std::size_t count(int width, int height) {
    return static_cast<std::size_t>(whole_subtiles(width)) *
           static_cast<std::size_t>(whole_subtiles(height));
  }
};

}  // namespace raytracer
