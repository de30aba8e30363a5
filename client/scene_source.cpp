#include "client/scene_source.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <vector>

#include "client/failure.h"

namespace raytracer::client {
namespace {

std::string read_to_end(std::FILE* file, const std::string& label) {
  std::string text;
  std::vector<char> buffer(1 << 16);
  // Asked only until the end was seen: a terminal would have to be told twice.
  while (std::feof(file) == 0 && std::ferror(file) == 0)
    text.append(buffer.data(), std::fread(buffer.data(), 1, buffer.size(), file));
  if (std::ferror(file) != 0)
    throw InputError(fmt::format("{}: cannot be read: {}", label, std::strerror(errno)));
  return text;
}

/// No shipped scene is called like this: it can only be meant as a path.
bool looks_like_path(const std::string& scene) {
  return scene.find('/') != scene.npos || scene.ends_with(".json");
}

}  // namespace

std::optional<SceneSource> read_scene_file(const std::string& scene) {
  if (scene == "-") return SceneSource{"standard input", read_to_end(stdin, "standard input")};
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(scene, error);
  if (!std::filesystem::exists(status)) {
    if (looks_like_path(scene)) throw InputError(scene + ": there is no such file");
    return std::nullopt;
  }
  if (std::filesystem::is_directory(status)) {
    if (looks_like_path(scene)) throw InputError(scene + ": is a directory, not a scene");
    return std::nullopt;
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(scene.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) throw InputError(fmt::format("{}: cannot be opened: {}", scene, std::strerror(errno)));
  return SceneSource{scene, read_to_end(file.get(), scene)};
}

SceneSource fetch_shipped_scene(const std::string& name, Api& api) {
  std::string known;
  for (const ShippedScene& scene : api.scenes()) {
    if (scene.name == name) return {name, api.scene_document(name), false};
    known += (known.empty() ? "" : ", ") + scene.name;
  }
  throw InputError(fmt::format(
      "{}: there is no such file, and no shipped scene of that name; there are: {}", name, known));
}

}  // namespace raytracer::client
