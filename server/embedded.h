// The files that are compiled into the program, so that it runs from anywhere: the shipped scenes,
// the page. embed.cmake writes the definition.
#pragma once

#include <span>
#include <string_view>

namespace raytracer {

/// A file that is compiled in.
struct EmbeddedFile {
  std::string_view path;  ///< "scenes/demo.json", "web/index.html", "openapi.json"
  std::string_view bytes;
};

/// All of them, ordered by path.
std::span<const EmbeddedFile> embedded_files();

/// The one with this path. Throws std::logic_error if there is none: then the build is broken.
const EmbeddedFile& embedded_file(std::string_view path);

/// Where the page's files stand: "web/index.html" is served as /index.html, and as /.
inline constexpr std::string_view page_folder = "web";

/// The media type that a file's ending stands for; application/octet-stream if none does.
std::string_view media_type_of(std::string_view path);

}  // namespace raytracer
