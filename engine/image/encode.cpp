#include "engine/image/encode.h"

#include <algorithm>
#include <bit>

#include "engine/image/png.h"
#include "engine/parallel/chunks.h"

namespace raytracer {
namespace {

LargeArray<unsigned char> to_bytes(const Image& image, WorkerPool& pool) {
  constexpr std::size_t few = 1 << 17;  // are converted before another thread has woken up
  LargeArray<unsigned char> bytes(image.values.size());
  for_each_chunk(bytes.size(), bytes.size() < few ? 1 : pool.thread_count(), pool,
                 [&](std::size_t, std::size_t begin, std::size_t end) {
                   std::transform(image.values.data() + begin, image.values.data() + end,
                                  bytes.data() + begin, to_byte);
                 });
  return bytes;
}

std::string netpbm_size(const Image& image) {
  return std::to_string(image.width) + ' ' + std::to_string(image.height) + '\n';
}

std::string encode_ppm(const Image& image, WorkerPool& pool) {
  const LargeArray<unsigned char> bytes = to_bytes(image, pool);
  std::string file = "P6\n" + netpbm_size(image) + "255\n";
  file.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
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

std::string encode(const Image& image, ImageFormat format, WorkerPool& pool) {
  switch (format) {
    case ImageFormat::png:
      return encode_png(image.width, image.height, to_bytes(image, pool), pool);
    case ImageFormat::ppm:
      return encode_ppm(image, pool);
    case ImageFormat::pfm:
      return encode_pfm(image);
  }
  return {};
}

}  // namespace raytracer
