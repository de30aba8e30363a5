#include "client/y4m.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "client/failure.h"

namespace raytracer::client {
namespace {

using Rgb = std::array<double, 3>;

/// BT.601, from bytes to bytes: 16 to 235, and 16 to 240 around 128.
char luma(const Rgb& c) {
  return static_cast<char>(
      static_cast<int>(16.5 + (65.481 * c[0] + 128.553 * c[1] + 24.966 * c[2]) / 255));
}
char blue_difference(const Rgb& c) {
  return static_cast<char>(
      static_cast<int>(128.5 + (-37.797 * c[0] - 74.203 * c[1] + 112 * c[2]) / 255));
}
char red_difference(const Rgb& c) {
  return static_cast<char>(
      static_cast<int>(128.5 + (112 * c[0] - 93.786 * c[1] - 18.214 * c[2]) / 255));
}

}  // namespace

std::string y4m_header(ImageSize size, FrameRate rate) {
  return fmt::format("YUV4MPEG2 W{} H{} F{}:{} Ip A1:1 C420jpeg\n", size.width_px, size.height_px,
                     rate.numerator, rate.denominator);
}

std::string y4m_frame(std::string_view ppm) {
  const auto header = netpbm_header(ppm, "P6");
  if (!header) throw ServerError("a frame is no PPM");
  const auto width = static_cast<std::size_t>(header->size.width_px);
  const auto height = static_cast<std::size_t>(header->size.height_px);
  if (ppm.size() != header->length + 3 * width * height)
    throw ServerError("a frame's PPM is not whole");
  const auto pixel = [&](std::size_t x, std::size_t y) {
    const char* const at = ppm.data() + header->length + 3 * (y * width + x);
    const auto byte = [](char c) { return static_cast<double>(static_cast<unsigned char>(c)); };
    return Rgb{byte(at[0]), byte(at[1]), byte(at[2])};
  };
  std::string frame = "FRAME\n";
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) frame += luma(pixel(x, y));
  std::string red;
  for (std::size_t y = 0; y < height; y += 2)
    for (std::size_t x = 0; x < width; x += 2) {
      Rgb mean{};
      for (const std::size_t row : {y, std::min(y + 1, height - 1)})
        for (const std::size_t column : {x, std::min(x + 1, width - 1)})
          for (std::size_t i = 0; i < 3; ++i) mean[i] += pixel(column, row)[i] / 4;
      frame += blue_difference(mean);
      red += red_difference(mean);
    }
  return frame + red;
}

}  // namespace raytracer::client
