#include "client/scene_text.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <vector>

#include "client/failure.h"
#include "client/formats/format.h"

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

/// The scene document that the text means.
std::string convert(const Format& format, const std::string& text, const std::string& label) {
  const Reading reading = format.read(text);
  std::vector<std::string> errors;
  for (const LineError& error : reading.errors)
    errors.push_back(fmt::format("{}:{}: {}", label, error.line, error.what));
  if (!errors.empty()) throw InputError(fmt::format("{}", fmt::join(errors, "\n")));
  for (const Omission& kind : reading.omissions)
    fmt::print(stderr, "{}:{}: {} {}\n", label, kind.first_line, kind.count,
               kind.count == 1 ? kind.one : kind.many);
  return model::to_document(reading.scene);
}

}  // namespace

std::optional<SceneText> read_scene_file(const std::string& scene) {
  if (scene == "-") return SceneText{"standard input", read_to_end(stdin, "standard input")};
  const Format* const format = format_of(scene);
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(scene, error);
  if (!std::filesystem::exists(status) || std::filesystem::is_directory(status)) {
    // No shipped scene is called like a path.
    if (scene.find('/') == scene.npos && !scene.ends_with(".json") && !format) return std::nullopt;
    throw InputError(scene + (std::filesystem::exists(status) ? ": is a directory, not a scene"
                                                              : ": there is no such file"));
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(scene.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) throw InputError(fmt::format("{}: cannot be opened: {}", scene, std::strerror(errno)));
  const std::string text = read_to_end(file.get(), scene);
  if (format) return SceneText{scene, convert(*format, text, scene), false};
  return SceneText{scene, text};
}

}  // namespace raytracer::client
