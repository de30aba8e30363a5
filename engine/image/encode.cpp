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
  const std::size_t row_size = 3 * sizeof(float) * static_cast<std::size_t>(image.width);
  file.reserve(file.size() + row_size * static_cast<std::size_t>(image.height));
  for (int y = image.height - 1; y >= 0; --y)
    file.append(reinterpret_cast<const char*>(image.pixel(0, y)), row_size);
  return file;
}

}  // namespace

ByteImage to_bytes(const Image& image, WorkerPool& pool) {
  constexpr std::size_t few = 1 << 17;  // are converted before another thread has woken up
  ByteImage bytes(image.width, image.height);
  const std::size_t count = image.values.size();
  for_each_chunk(count, count < few ? 1 : pool.thread_count(), pool,
                 [&](std::size_t, std::size_t begin, std::size_t end) {
                   std::transform(image.values.data() + begin, image.values.data() + end,
                                  bytes.values.data() + begin, to_byte);
                 });
  return bytes;
}

std::string encode(const Image& image, ImageFormat format, WorkerPool& pool) {
  return holds_floats(format) ? encode_pfm(image) : encode(to_bytes(image, pool), format, pool);
}

std::string encode(const ByteImage& image, ImageFormat format, WorkerPool& pool) {
  switch (format) {
    case ImageFormat::png:
      return encode_png(image.width, image.height, image.values, pool);
    case ImageFormat::ppm:
      return encode_ppm(image);
    case ImageFormat::pfm:
      break;
  }
  throw std::logic_error("8 bits for a file of floats");
}

}  // namespace raytracer
