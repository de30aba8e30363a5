#include "tests/golden/picture.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <regex>
#include <stdexcept>

namespace raytracer::test {
namespace {

/// The header of a P6 or PF and what follows it.
struct Netpbm {
  int width = 0;
  int height = 0;
  std::string last_value;
  std::string_view raster;
};

Netpbm read_header(std::string_view bytes, const std::string& magic) {
  const std::regex pattern("^" + magic + R"(\s+(\d+)\s+(\d+)\s+(\S+)\s)");
  const std::string beginning(bytes.substr(0, 100));
  std::smatch match;
  if (!std::regex_search(beginning, match, pattern))
    throw std::runtime_error("no " + magic + " header: " + beginning.substr(0, 20));
  return {std::stoi(match[1]), std::stoi(match[2]), match[3],
          bytes.substr(static_cast<std::size_t>(match.length()))};
}

void demand_size(const Netpbm& file, std::size_t channel_bytes) {
  const std::size_t expected = 3 * channel_bytes * static_cast<std::size_t>(file.width) *
                               static_cast<std::size_t>(file.height);
  if (file.raster.size() != expected)
    throw std::runtime_error(fmt::format("{} bytes of pixels instead of {} for {} x {}",
                                         file.raster.size(), expected, file.width, file.height));
}

/// The bytes of an 8-bit PNG of this format and no other; sets its size.
std::vector<std::uint8_t> png_bytes(std::string_view bytes, png_uint_32 format, int& width,
                                    int& height) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0)
    throw std::runtime_error(fmt::format("not a PNG: {}", image.message));
  // 8-bit files give their own bytes back; 16-bit or palette files are not what is tested here.
  if (image.format != format) {
    png_image_free(&image);
    throw std::runtime_error("the PNG is not 8-bit RGB or RGBA, as it should be");
  }
  width = static_cast<int>(image.width);
  height = static_cast<int>(image.height);
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) == 0)
    throw std::runtime_error(fmt::format("a broken PNG: {}", image.message));
  if (image.warning_or_error != 0)
    throw std::runtime_error(fmt::format("a doubtful PNG: {}", image.message));
  return pixels;
}

}  // namespace

Picture decode_png(std::string_view bytes) {
  Picture picture;
  picture.rgb = png_bytes(bytes, PNG_FORMAT_RGB, picture.width, picture.height);
  return picture;
}

CoveredPicture decode_covered_png(std::string_view bytes) {
  CoveredPicture picture;
  picture.rgba = png_bytes(bytes, PNG_FORMAT_RGBA, picture.width, picture.height);
  return picture;
}

Picture decode_ppm(std::string_view bytes) {
  const Netpbm file = read_header(bytes, "P6");
  if (file.last_value != "255") throw std::runtime_error("P6 not of 255: " + file.last_value);
  demand_size(file, 1);
  return {file.width, file.height, {file.raster.begin(), file.raster.end()}};
}

Picture decode_pfm(std::string_view bytes) {
  const Netpbm file = read_header(bytes, "PF");
  if (std::stod(file.last_value) != -1.0 || std::endian::native != std::endian::little)
    throw std::runtime_error("PF not of little-endian floats: " + file.last_value);
  demand_size(file, sizeof(float));
  Picture picture{file.width, file.height, {}};
  const std::size_t row_length = 3 * static_cast<std::size_t>(file.width);
  for (int row = file.height - 1; row >= 0; --row) {  // PF begins with the bottom row
    for (std::size_t i = 0; i < row_length; ++i) {
      float channel = 0;
      const std::size_t index = static_cast<std::size_t>(row) * row_length + i;
      std::memcpy(&channel, file.raster.data() + index * sizeof channel, sizeof channel);
      if (!(channel >= 0 && channel <= 1))
        throw std::runtime_error(fmt::format("a channel of {}", channel));
      picture.rgb.push_back(static_cast<std::uint8_t>(std::floor(255.0 * channel + 0.5)));
    }
  }
  return picture;
}

Difference compare(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height)
    throw std::runtime_error(
        fmt::format("{} x {} against {} x {}", a.width, a.height, b.width, b.height));
  Difference difference;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
    int levels = 0;
    for (std::size_t c = i; c < i + 3; ++c)
      levels = std::max(levels, std::abs(a.rgb[c] - b.rgb[c]));
    difference.most_levels = std::max(difference.most_levels, levels);
    difference.different_count += levels > 0 ? 1 : 0;
  }
  return difference;
}

}  // namespace raytracer::test
