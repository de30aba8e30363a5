// Pixels as the engine leaves them: after the transfer, as floats or rounded to 8 bits.
//
// Most pictures end as 8 bits, which are a quarter of the memory: a kernel that stores these itself
// saves writing the floats and reading them again, which for simple scenes takes longer than to
// trace them.
#pragma once

#include <cstddef>
#include <variant>

#include "engine/memory/page_allocator.h"

namespace raytracer {

/// width x height pixels of three channels, row 0 on top.
template <typename Channel>
struct Raster {
  int width = 0;
  int height = 0;
  LargeArray<Channel> values;  ///< 3 * width * height: red, green, blue

  Raster() = default;
  /// The values are not set.
  Raster(int width_px, int height_px)
      : width(width_px),
        height(height_px),
        values(3 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {}

  /// The first of the three values of pixel (x, y), y = 0 on top.
  Channel* pixel(int x, int y) { return values.data() + 3 * index(x, y); }
  const Channel* pixel(int x, int y) const { return values.data() + 3 * index(x, y); }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

/// Channels in [0, 1].
using Image = Raster<float>;
/// Channels from 0 to 255.
using ByteImage = Raster<unsigned char>;

/// What a kernel stores into: nothing but the values of the pixels that it is told to trace.
using Canvas = std::variant<Image*, ByteImage*>;

/// The 8-bit value of a channel in [0, 1]: floor(255 c + 1/2), exact in double.
inline unsigned char to_byte(float channel) {
  const double raised = 255 * static_cast<double>(channel) + 0.5;
  return static_cast<unsigned char>(static_cast<int>(raised));
}

}  // namespace raytracer
