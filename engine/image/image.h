// Pixels as the engine leaves them: after the transfer, as floats or rounded to 8 bits.
//
// An image has three channels, red, green and blue, or a fourth where nothing stands behind the
// objects: its cover, the share of a pixel's samples that met one. The colours of what they met are
// then multiplied by the cover, after the transfer: over black, an image of floats is right as it
// is, and its errors count for as much as they are seen. Files hold the colours themselves.
//
// Most pictures end as 8 bits, which are a quarter of the memory: a kernel that stores these itself
// saves writing the floats and reading them again, which for simple scenes takes longer than to
// trace them.
#pragma once

#include <cstddef>
#include <variant>

#include "engine/memory/page_allocator.h"

namespace raytracer {

/// width x height pixels of three or four channels, row 0 on top.
template <typename Channel>
struct Raster {
  int width = 0;
  int height = 0;
  int channels = 3;
  LargeArray<Channel> values;  ///< channels * width * height

  Raster() = default;
  /// The values are not set.
  Raster(int width_px, int height_px, int channel_count = 3)
      : width(width_px),
        height(height_px),
        channels(channel_count),
        values(length_of(width_px) * static_cast<std::size_t>(height_px)) {}
  Raster(const Raster&) = default;
  Raster(Raster&&) noexcept = default;
  Raster& operator=(const Raster&) = default;
  Raster& operator=(Raster&&) noexcept = default;
  /// Compiled with the engine: below -O2 g++ has a vector with an allocator walk over its elements
  /// to destroy nothing of each.
  ~Raster();

  /// The first of the values of pixel (x, y), y = 0 on top.
  Channel* pixel(int x, int y) { return values.data() + index(x, y); }
  const Channel* pixel(int x, int y) const { return values.data() + index(x, y); }

  /// How many values so many pixels have.
  std::size_t length_of(int pixels) const {
    return static_cast<std::size_t>(channels) * static_cast<std::size_t>(pixels);
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * length_of(width) + length_of(x);
  }
};

extern template struct Raster<float>;
extern template struct Raster<unsigned char>;

/// Channels in [0, 1].
using Image = Raster<float>;
/// Channels from 0 to 255.
using ByteImage = Raster<unsigned char>;

/// What a kernel stores into: nothing but the values of the pixels that it is told to trace. Bytes
/// are of three channels; with a cover they are made from floats.
using Canvas = std::variant<Image*, ByteImage*>;

/// The 8-bit value of a channel in [0, 1]: floor(255 c + 1/2). In single precision, which rounds
/// 255 times what is nearest to 0.1, 0.3, 0.5, 0.7 or 0.9 to the tie that a person means by it.
inline unsigned char to_byte(float channel) {
  const float raised = 255 * channel + 0.5F;
  return static_cast<unsigned char>(static_cast<int>(raised));
}

}  // namespace raytracer
