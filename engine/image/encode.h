// An image as the bytes of a file.
#pragma once

#include <string>

#include "engine/image/image.h"
#include "engine/parallel/worker_pool.h"

namespace raytracer {

enum class ImageFormat {
  png,  ///< 8 bits, image/png
  ppm,  ///< 8 bits, P6, image/x-portable-pixmap
  pfm,  ///< PF, little-endian floats from the bottom row up, image/x-portable-floatmap
};

/// The 8-bit value of a channel in [0, 1]: floor(255 c + 1/2), exact in double.
inline unsigned char to_byte(float channel) {
  const double raised = 255 * static_cast<double>(channel) + 0.5;
  return static_cast<unsigned char>(static_cast<int>(raised));
}

/// The file's bytes, made on the pool's threads; the same however many there are.
/// Throws std::bad_alloc, or std::runtime_error if the encoder fails.
std::string encode(const Image& image, ImageFormat format, WorkerPool& pool);

}  // namespace raytracer
