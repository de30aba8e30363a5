// A PNG's pixels, for pictures that come in no simpler format: those with a transparent background.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "client/image_format.h"

namespace raytracer::client {

struct PngPixels {
  ImageSize size;
  std::vector<unsigned char> rgba;  ///< row by row from the top, not premultiplied
};

/// None if the bytes are no whole PNG.
std::optional<PngPixels> decode_png(std::string_view bytes);

}  // namespace raytracer::client
