// An image as the bytes of a file.
#pragma once

#include <string>

#include "engine/image/image.h"

namespace raytracer {

enum class ImageFormat {
  png,  ///< 8 bits, image/png
  ppm,  ///< 8 bits, P6, image/x-portable-pixmap
  pfm,  ///< PF, little-endian floats from the bottom row up, image/x-portable-floatmap
};

/// The 8-bit value of a channel in [0, 1]: floor(255 c + 1/2).
unsigned char to_byte(float channel);

/// The file's bytes. Throws std::runtime_error if the encoder fails (out of memory).
std::string encode(const Image& image, ImageFormat format);

}  // namespace raytracer
