// The files that are compiled into the program, so that it runs from anywhere: the shipped scenes,
// the page, the schema. embed.cmake writes the definition.
#pragma once

#include <span>
#include <string_view>

namespace raytracer {

struct EmbeddedFile {
  std::string_view path;  ///< "scenes/demo.json", "web/index.html", "scene.schema.json"
  std::string_view bytes;
};

/// All of them, ordered by path.
std::span<const EmbeddedFile> embedded_files();

/// The media type that a file's ending stands for; application/octet-stream if none does.
std::string_view media_type_of(std::string_view path);

}  // namespace raytracer
