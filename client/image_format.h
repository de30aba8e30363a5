// The image formats by ending and media type, and the size that a file's header says.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace raytracer::client {

struct ImageFormat {
  std::string_view ending;
  std::string_view media_type;
};

inline constexpr ImageFormat png_format{".png", "image/png"};
inline constexpr ImageFormat ppm_format{".ppm", "image/x-portable-pixmap"};
inline constexpr ImageFormat pfm_format{".pfm", "image/x-portable-floatmap"};
inline constexpr std::array image_formats{png_format, ppm_format, pfm_format};

/// By an ending in lower case, with its point. Null if it is no format's.
const ImageFormat* image_format_of(std::string_view ending);

struct ImageSize {
  int width_px = 0;
  int height_px = 0;

  bool operator==(const ImageSize&) const = default;
};

/// What the header of a PNG, P6 or PF says; none if the bytes are neither.
std::optional<ImageSize> image_size(std::string_view bytes);

/// Whether the bytes are a PNG, P6 or PF to its end, by their lengths alone.
bool is_whole_image(std::string_view bytes);

/// A P6 or PF header: its size, and where the pixels begin.
struct NetpbmHeader {
  ImageSize size;
  std::size_t length = 0;  ///< bytes
};

/// None if the bytes do not begin with `magic` and three header values.
std::optional<NetpbmHeader> netpbm_header(std::string_view bytes, std::string_view magic);

}  // namespace raytracer::client
