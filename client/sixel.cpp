#include "client/sixel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <vector>

namespace raytracer::client {
namespace {

constexpr int levels = 6;
constexpr int band_height = 6;

/// Thresholds in 16ths of a level (Bayer 1973).
constexpr std::array<std::array<int, 4>, 4> dither{
    {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}}};

int color_at(const Pixmap& picture, int x, int y) {
  const std::size_t first =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
           static_cast<std::size_t>(x));
  const int threshold = dither[static_cast<std::size_t>(y % 4)][static_cast<std::size_t>(x % 4)];
  int color = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const int sixteenths = picture.rgb[first + c] * (levels - 1) * 16 / 255;
    color = color * levels + std::min(levels - 1, (sixteenths + threshold) / 16);
  }
  return color;
}

/// One colour's pixels in a band, equal neighbours counted: "!12~".
void append_row(std::string& text, const std::vector<int>& bits) {
  for (std::size_t x = 0; x < bits.size();) {
    std::size_t end = x + 1;
    while (end < bits.size() && bits[end] == bits[x]) ++end;
    const char sixel = static_cast<char>('?' + bits[x]);
    if (end - x > 3)
      fmt::format_to(std::back_inserter(text), "!{}{}", end - x, sixel);
    else
      text.append(end - x, sixel);
    x = end;
  }
}

}  // namespace

std::string sixels(const Pixmap& picture, const TerminalSize& size) {
  const Pixmap small = fitted(picture, size, 10, 20);

  std::string text = fmt::format("\033P0;1q\"1;1;{};{}", small.width, small.height);
  for (int color = 0; color < levels * levels * levels; ++color)
    fmt::format_to(std::back_inserter(text), "#{};2;{};{};{}", color,
                   color / (levels * levels) * 100 / (levels - 1),
                   color / levels % levels * 100 / (levels - 1),
                   color % levels * 100 / (levels - 1));
  for (int top = 0; top < small.height; top += band_height) {
    const int rows = std::min(band_height, small.height - top);
    std::vector<std::array<int, band_height>> colors(static_cast<std::size_t>(small.width));
    std::set<int> used;
    for (int x = 0; x < small.width; ++x)
      for (int row = 0; row < rows; ++row) {
        const int color = color_at(small, x, top + row);
        colors[static_cast<std::size_t>(x)][static_cast<std::size_t>(row)] = color;
        used.insert(color);
      }
    for (const int color : used) {
      std::vector<int> bits(colors.size(), 0);
      for (std::size_t x = 0; x < colors.size(); ++x)
        for (int row = 0; row < rows; ++row)
          if (colors[x][static_cast<std::size_t>(row)] == color) bits[x] |= 1 << row;
      fmt::format_to(std::back_inserter(text), "#{}", color);
      append_row(text, bits);
      text += '$';  // back to the band's beginning
    }
    text += '-';
  }
  return text + "\033\\\n";
}

}  // namespace raytracer::client
