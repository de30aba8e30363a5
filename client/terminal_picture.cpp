#include "client/terminal_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "client/failure.h"
#include "client/image_format.h"

namespace raytracer::client {
namespace {

std::size_t channel_index(const Pixmap& picture, int x, int y) {
  return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
              static_cast<std::size_t>(x));
}

/// How much of the pixel [i, i + 1) lies in [begin, end).
double overlap(int i, double begin, double end) {
  return std::min(end, i + 1.0) - std::max(begin, static_cast<double>(i));
}

/// The mean colour over [x0, x1) x [y0, y1), in pixels.
std::array<unsigned char, 3> mean(const Pixmap& picture, double x0, double x1, double y0,
                                  double y1) {
  std::array<double, 3> sum{};
  double weights = 0;
  const int y_end = std::min(static_cast<int>(std::ceil(y1)), picture.height);
  const int x_end = std::min(static_cast<int>(std::ceil(x1)), picture.width);
  for (int y = static_cast<int>(y0); y < y_end; ++y) {
    for (int x = static_cast<int>(x0); x < x_end; ++x) {
      const double weight = overlap(x, x0, x1) * overlap(y, y0, y1);
      weights += weight;
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += weight * picture.rgb[channel_index(picture, x, y) + c];
    }
  }
  std::array<unsigned char, 3> color{};
  for (std::size_t c = 0; c < 3; ++c)
    color[c] = static_cast<unsigned char>(std::lround(sum[c] / weights));
  return color;
}

}  // namespace

Pixmap read_ppm(std::string_view bytes) {
  const auto header = netpbm_header(bytes, "P6");
  if (!header) throw ServerError("the server's answer is not the P6 image that was asked for");
  Pixmap picture{header->size.width_px, header->size.height_px, {}};
  const std::string_view pixels = bytes.substr(header->length);
  if (pixels.size() != channel_index(picture, 0, picture.height))
    throw ServerError("the server's image is not whole");
  picture.rgb.assign(pixels.begin(), pixels.end());
  return picture;
}

Pixmap shrink(const Pixmap& picture, int width, int height) {
  Pixmap small{width, height, {}};
  small.rgb.reserve(channel_index(small, 0, height));
  const double step_x = static_cast<double>(picture.width) / width;
  const double step_y = static_cast<double>(picture.height) / height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const unsigned char channel :
           mean(picture, x * step_x, (x + 1) * step_x, y * step_y, (y + 1) * step_y))
        small.rgb.push_back(channel);
  return small;
}

Pixmap fitted(const Pixmap& picture, const TerminalSize& size, double column_px, double row_px) {
  const double scale = std::min({1.0, column_px * std::max(size.columns, 1) / picture.width,
                                 row_px * std::max(size.rows, 1) / picture.height});
  const auto scaled = [&](int length) { return std::max(1, static_cast<int>(length * scale)); };
  return shrink(picture, scaled(picture.width), scaled(picture.height));
}

std::string half_blocks(const Pixmap& picture, const TerminalSize& size) {
  const Pixmap small = fitted(picture, size, 1, 2);

  std::string text;
  const auto color = [&](const char* layer, int x, int y) {
    const std::size_t i = channel_index(small, x, y);
    fmt::format_to(std::back_inserter(text), "\033[{};2;{};{};{}m", layer, small.rgb[i],
                   small.rgb[i + 1], small.rgb[i + 2]);
  };
  for (int y = 0; y < small.height; y += 2) {
    for (int x = 0; x < small.width; ++x) {
      color("38", x, y);
      if (y + 1 < small.height) color("48", x, y + 1);
      text += "▀";
    }
    text += "\033[0m\n";
  }
  return text;
}

std::string characters(const Pixmap& picture, const TerminalSize& size) {
  constexpr std::string_view from_dark_to_light = " .:-=+*#%@";
  const Pixmap pixels = fitted(picture, size, 1, 2);
  const Pixmap small = shrink(pixels, pixels.width, std::max(1, pixels.height / 2));
  std::string text;
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      const std::size_t i = channel_index(small, x, y);
      // Luma of Rec. 709, in thousandths.
      const int luma = (213 * small.rgb[i] + 715 * small.rgb[i + 1] + 72 * small.rgb[i + 2]) / 1000;
      text += from_dark_to_light[static_cast<std::size_t>(luma) * from_dark_to_light.size() / 256];
    }
    text += '\n';
  }
  return text;
}

}  // namespace raytracer::client
