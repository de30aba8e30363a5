#include "engine/image/encode.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "engine/image/png.h"
#include "engine/parallel/chunks.h"

namespace raytracer {
namespace {

template <typename Channel>
std::string netpbm_size(const Raster<Channel>& image) {
  return std::to_string(image.width) + ' ' + std::to_string(image.height) + '\n';
}

std::string encode_ppm(const ByteImage& image) {
  std::string file = "P6\n" + netpbm_size(image) + "255\n";
  file.append(reinterpret_cast<const char*>(image.values.data()), image.values.size());
  return file;
}

std::string encode_pfm(const Image& image) {
  static_assert(std::endian::native == std::endian::little);  // and so are the file's floats
  std::string file = "PF\n" + netpbm_size(image) + "-1.0\n";
  const std::size_t row_size = sizeof(float) * image.length_of(image.width);
  file.reserve(file.size() + row_size * static_cast<std::size_t>(image.height));
  for (int y = image.height - 1; y >= 0; --y)
    file.append(reinterpret_cast<const char*>(image.pixel(0, y)), row_size);
  return file;
}

/// The colour that was multiplied by the cover, and this.
void uncover(const float* pixel, unsigned char* bytes) {
  const double cover = static_cast<double>(pixel[3]);
  for (int channel = 0; channel < 3; ++channel) {
    const double color = cover > 0 ? static_cast<double>(pixel[channel]) / cover : 0;
    bytes[channel] = to_byte(static_cast<float>(std::min(color, 1.0)));
  }
  bytes[3] = to_byte(pixel[3]);
}

void require_channels(ImageFormat format, int channels) {
  if (!holds_channels(format, channels))
    throw std::logic_error("a file of three channels for an image of four");
}

}  // namespace

ByteImage to_bytes(const Image& image, WorkerPool& pool) {
  constexpr std::size_t few = 1 << 17;  // are converted before another thread has woken up
  ByteImage bytes(image.width, image.height, image.channels);
  const std::size_t count = image.values.size();
  const std::size_t unit = image.channels == 3 ? 1 : image.length_of(1);
  for_each_chunk(count / unit, count < few ? 1 : pool.thread_count(), pool,
                 [&](std::size_t, std::size_t begin, std::size_t end) {
                   const float* const from = image.values.data();
                   unsigned char* const to = bytes.values.data();
                   if (unit == 1)
                     std::transform(from + begin, from + end, to + begin, to_byte);
                   else
                     for (std::size_t i = begin; i < end; ++i)
                       uncover(from + unit * i, to + unit * i);
                 });
  return bytes;
}

std::string encode(const Image& image, ImageFormat format, WorkerPool& pool) {
  if (!holds_floats(format)) return encode(to_bytes(image, pool), format, pool);
  require_channels(format, image.channels);
  return encode_pfm(image);
}

std::string encode(const ByteImage& image, ImageFormat format, WorkerPool& pool) {
  require_channels(format, image.channels);
  switch (format) {
    case ImageFormat::png:
      return encode_png(image.width, image.height, image.channels, image.values, pool);
    case ImageFormat::ppm:
      return encode_ppm(image);
    case ImageFormat::pfm:
      break;
  }
  throw std::logic_error("8 bits for a file of floats");
}

}  // namespace raytracer
