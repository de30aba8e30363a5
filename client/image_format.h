// The image formats by ending, by media type, and the size that a file's header says.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace raytracer::client {

enum class ImageFormat { png, ppm, pfm };

inline constexpr std::string_view known_endings = ".png, .ppm and .pfm";

/// ".png" of "picture.PNG"
std::string lower_case_ending(const std::filesystem::path& path);

/// The format that the path's ending names, in upper or lower case.
std::optional<ImageFormat> format_of(const std::filesystem::path& path);

/// "image/png"
std::string_view media_type(ImageFormat format);

struct ImageSize {
  int width_px = 0;
  int height_px = 0;
};

/// What the header of a PNG, P6 or PF says; none if the bytes are neither.
std::optional<ImageSize> image_size(std::string_view bytes);

/// A P6 or PF header: its size, and where the pixels begin.
struct NetpbmHeader {
  ImageSize size;
  std::size_t length = 0;  ///< bytes
};

/// None if the bytes do not begin with `magic` and three header values.
std::optional<NetpbmHeader> netpbm_header(std::string_view bytes, std::string_view magic);

}  // namespace raytracer::client
