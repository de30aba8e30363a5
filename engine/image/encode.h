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

/// Whether the format holds images of so many channels.
inline bool holds_channels(ImageFormat format, int channels) {
  return channels == 3 || format == ImageFormat::png;
}

/// Whether the format holds more than 8 bits of a channel.
inline bool holds_floats(ImageFormat format) { return format == ImageFormat::pfm; }

/// The image rounded to 8 bits, on the pool's threads; where it has a cover, the colours themselves
/// instead of those multiplied by it.
ByteImage to_bytes(const Image& image, WorkerPool& pool);

/// The file's bytes, made on the pool's threads; the same however many there are.
/// Throws std::bad_alloc, std::runtime_error if the encoder fails, or std::logic_error if the
/// format does not hold the image's channels.
std::string encode(const Image& image, ImageFormat format, WorkerPool& pool);

/// The same; std::logic_error also if the format holds floats.
std::string encode(const ByteImage& image, ImageFormat format, WorkerPool& pool);

}  // namespace raytracer
