// Pixels as the engine leaves them: after the transfer, before rounding to 8 bits.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/memory/page_allocator.h"

namespace raytracer {

/// width x height pixels of three floats in [0, 1], row 0 on top.
struct Image {
  int width = 0;
  int height = 0;
  LargeArray<float> values;  ///< 3 * width * height: red, green, blue

  Image() = default;
  /// The values are not set.
  Image(int width_px, int height_px)
      : width(width_px),
        height(height_px),
        values(3 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {}

  /// The first of the three values of pixel (x, y), y = 0 on top.
  float* pixel(int x, int y) { return values.data() + 3 * index(x, y); }
  const float* pixel(int x, int y) const { return values.data() + 3 * index(x, y); }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

}  // namespace raytracer
