#include "client/image_format.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace raytracer::client {
namespace {

constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n";

/// A big-endian integer of a PNG; 0 where the bytes end.
int png_integer(std::string_view bytes, std::size_t at) {
  unsigned value = 0;
  for (const char c : bytes.substr(at, 4)) value = value << 8 | static_cast<unsigned char>(c);
  return static_cast<int>(value);
}

}  // namespace

const ImageFormat* image_format_of(std::string_view ending) {
  const auto* const format =
      std::find_if(image_formats.begin(), image_formats.end(),
                   [&](const ImageFormat& each) { return each.ending == ending; });
  return format == image_formats.end() ? nullptr : format;
}

std::optional<NetpbmHeader> netpbm_header(std::string_view bytes, std::string_view magic) {
  if (!bytes.starts_with(magic)) return std::nullopt;
  constexpr std::string_view white = " \t\r\n";
  std::size_t at = magic.size();
  std::array<int, 2> size{};
  for (int field = 0; field < 3; ++field) {  // width, height, and the largest value or scale
    const std::size_t begin = bytes.find_first_not_of(white, at);
    const std::size_t end = bytes.find_first_of(white, begin);
    if (begin == at || end == bytes.npos) return std::nullopt;
    if (field < 2) {
      int& value = size[static_cast<std::size_t>(field)];
      const auto read = std::from_chars(bytes.data() + begin, bytes.data() + end, value);
      if (read.ec != std::errc() || read.ptr != bytes.data() + end || value < 1)
        return std::nullopt;
    }
    at = end;
  }
  return NetpbmHeader{{size[0], size[1]}, at + 1};
}

std::optional<ImageSize> image_size(std::string_view bytes) {
  if (bytes.starts_with(png_signature) && bytes.size() >= 24)
    return ImageSize{png_integer(bytes, 16), png_integer(bytes, 20)};
  for (const std::string_view magic : {"P6", "PF"})
    if (const auto header = netpbm_header(bytes, magic)) return header->size;
  return std::nullopt;
}

bool is_whole_image(std::string_view bytes) {
  constexpr std::string_view png_end = "IEND\xae\x42\x60\x82";  // the last chunk, and its checksum
  if (bytes.starts_with(png_signature)) return bytes.ends_with(png_end);
  const auto holds = [&](std::string_view magic, std::size_t pixel_bytes) {
    const auto header = netpbm_header(bytes, magic);
    return header &&
           bytes.size() == header->length + pixel_bytes *
                                                static_cast<std::size_t>(header->size.width_px) *
                                                static_cast<std::size_t>(header->size.height_px);
  };
  return holds("P6", 3) || holds("PF", 3 * sizeof(float));
}

}  // namespace raytracer::client
