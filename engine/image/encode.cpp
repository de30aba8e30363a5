#include "engine/image/encode.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include "engine/image/png.h"

namespace raytracer {
namespace {

std::vector<unsigned char> to_bytes(const Image& image) {
  std::vector<unsigned char> bytes(image.values.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = to_byte(image.values[i]);
  return bytes;
}

std::string netpbm_size(const Image& image) {
  return std::to_string(image.width) + ' ' + std::to_string(image.height) + '\n';
}

std::string encode_ppm(const Image& image) {
  const std::vector<unsigned char> bytes = to_bytes(image);
  std::string file = "P6\n" + netpbm_size(image) + "255\n";
  file.append(bytes.begin(), bytes.end());
  return file;
}

std::string encode_pfm(const Image& image) {
  std::string file = "PF\n" + netpbm_size(image) + "-1.0\n";  // negative: little-endian
  file.reserve(file.size() + 4 * image.values.size());
  for (int y = image.height - 1; y >= 0; --y) {
    const float* row = image.pixel(0, y);
    for (int i = 0; i < 3 * image.width; ++i) {
      const auto bits = std::bit_cast<std::uint32_t>(row[i]);
      for (int shift = 0; shift < 32; shift += 8) file += static_cast<char>(bits >> shift & 0xff);
    }
  }
  return file;
}

}  // namespace

unsigned char to_byte(float channel) {
  return static_cast<unsigned char>(std::floor(255 * static_cast<double>(channel) + 0.5));
}

std::string encode(const Image& image, ImageFormat format) {
  switch (format) {
    case ImageFormat::png:
      return encode_png(image.width, image.height, to_bytes(image));
    case ImageFormat::ppm:
      return encode_ppm(image);
    case ImageFormat::pfm:
      return encode_pfm(image);
  }
  return {};
}

}  // namespace raytracer
