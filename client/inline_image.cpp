#include "client/inline_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>

#include "client/failure.h"
#include "client/image_format.h"

namespace raytracer::client {
namespace {

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8U | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? digits[group >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

/// In how many columns the picture fits, a cell being twice as high as wide and a pixel no wider
/// than an eighth of one.
int columns_for(std::string_view png, const TerminalSize& size) {
  constexpr int cell_px = 8;
  const std::optional<ImageSize> image = image_size(png);
  if (!image) throw ServerError("the server's answer is not the PNG that was asked for");
  const auto& [width_px, height_px] = *image;
  const double by_rows = 2.0 * std::max(size.rows, 1) * width_px / height_px;
  const int own = (width_px + cell_px - 1) / cell_px;
  return std::max(1, std::min({size.columns, own, static_cast<int>(by_rows)}));
}

}  // namespace

std::string kitty_image(std::string_view png, const TerminalSize& size) {
  constexpr std::size_t most_in_a_chunk = 4096;
  const std::string data = base64(png);
  std::string text;
  for (std::size_t i = 0; i < data.size(); i += most_in_a_chunk) {
    const int more = i + most_in_a_chunk < data.size() ? 1 : 0;
    // f=100: PNG; a=T: transmit and show; q=2: no answers.
    const std::string keys =
        i == 0 ? fmt::format("f=100,a=T,q=2,c={},m={}", columns_for(png, size), more)
               : fmt::format("m={}", more);
    text +=
        fmt::format("\033_G{};{}\033\\", keys, std::string_view(data).substr(i, most_in_a_chunk));
  }
  return text + '\n';
}

std::string iterm_image(std::string_view png, const TerminalSize& size) {
  return fmt::format("\033]1337;File=inline=1;size={};width={};preserveAspectRatio=1:{}\a\n",
                     png.size(), columns_for(png, size), base64(png));
}

}  // namespace raytracer::client
