// Pixels that are sampled by themselves.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/image/pixel_spreads.h"

namespace raytracer {

/// Some pixels of the block that begins at pixel (x_begin, y_begin), at most all of it, each once.
struct BlockPixels {
  int x_begin;
  int y_begin;
  std::span<const std::uint8_t> places;  ///< row by row: column + block_side * row
  int channels = 3;                      ///< of their image
};

/// What a pixel's samples came to.
struct SampledPixel {
  std::array<float, 4> values{};  ///< as the image holds them
  PixelSpread spread{};
  bool is_number = true;  ///< none of its samples was not
};

}  // namespace raytracer
