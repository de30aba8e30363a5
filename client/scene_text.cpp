#include "client/scene_text.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "client/failure.h"
#include "client/formats/format.h"
#include "client/formats/text_source.h"
#include "client/formats/words.h"
#include "client/notice.h"

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

/// In the place of an InputError that does not name its file.
template <typename Read>
auto naming(const std::string& label, Read read) {
  try {
    return read();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", label, error.what()));
  }
}

ImportOptions with_size(ImportOptions options, const Overrides& overrides) {
  const auto replace = [&](const char* name, int& value) {
    const auto given = overrides.find(name);
    if (given != overrides.end()) value = std::stoi(given->second);
  };
  replace("width", options.width_px);
  replace("height", options.height_px);
  return options;
}

std::unique_ptr<SceneFile> open(const Format& format, const SceneChoice& choice,
                                const Overrides& overrides) {
  return format.open({source_of_file(choice.name), choice.name},
                     with_size(choice.import_options, overrides));
}

/// The scene document that a frame means.
SceneText document_of(const Reading& reading, const std::string& label) {
  std::vector<std::string> errors;
  for (const LineError& error : reading.errors)
    errors.push_back(error.line > 0 ? fmt::format("{}:{}: {}", label, error.line, error.what)
                                    : fmt::format("{}: {}", label, error.what));
  if (!errors.empty()) throw InputError(fmt::format("{}", fmt::join(errors, "\n")));
  for (const Omission& kind : reading.omissions) {
    const std::string place =
        kind.first_line > 0 ? fmt::format("{}:{}", label, kind.first_line) : label;
    notice(fmt::format("{}: {} {}", place, kind.count, kind.count == 1 ? kind.one : kind.many));
  }
  return {label, model::to_document(reading.scene), false};
}

/// The first character that is no white space; a space if there is none.
char first_character(const std::string& text) {
  const std::string_view content = without_byte_order_mark(text);
  const std::size_t begin = content.find_first_not_of(" \t\r\n");
  return begin == content.npos ? ' ' : content[begin];
}

/// A document is known by its content; whoever gives another file its ending wants it read so.
SceneText read_document(const std::string& path) {
  std::string text = read_all(*source_of_file(path));
  if (!without_compression(path).ends_with(".json") && first_character(text) != '{')
    throw InputError(
        fmt::format("is no scene document, and its ending is none of {}", all_endings()));
  return {path, std::move(text)};
}

SceneText read_standard_input() {
  SceneText scene{"standard input", read_to_end(stdin, "standard input")};
  if (const char first = first_character(scene.text); first != '{' && first != ' ')
    throw InputError(
        "standard input: is no scene document, which begins with {; other formats are known by "
        "their ending: name a file");
  return scene;
}

/// Flags about what a scene says itself are refused.
void refuse_flags(const SceneChoice& choice, Openness openness) {
  for (const std::string& flag : choice.flags_given) {
    const Openness needed = flag == "--view" || flag == "--zoom" ? Openness::missing_view
                            : flag == "--background"             ? Openness::picture
                                                                 : Openness::atoms;
    if (openness >= needed) continue;
    throw InputError(fmt::format(
        "{}: {} does without it; the option is for {}", flag, choice.name,
        needed == Openness::atoms ? "atoms and other particles" : "formats without a camera"));
  }
}

}  // namespace

std::optional<SceneText> read_scene_file(const SceneChoice& choice, const Overrides& overrides) {
  const std::string& scene = choice.name;
  const Format* const format = format_of(scene);
  refuse_flags(choice, format ? format->openness : Openness::nothing);
  if (scene == "-") return read_standard_input();
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(scene, error);
  if (!std::filesystem::exists(status) || std::filesystem::is_directory(status)) {
    // No shipped scene is called like a path.
    if (scene.find('/') == scene.npos && !scene.ends_with(".json") && !format) return std::nullopt;
    throw InputError(scene + (std::filesystem::exists(status) ? ": is a directory, not a scene"
                                                              : ": there is no such file"));
  }
  if (!format) return naming(scene, [&] { return read_document(scene); });
  const auto file = naming(scene, [&] { return open(*format, choice, overrides); });
  const Reading reading = naming(scene, [&] { return file->next_frame().value(); });
  SceneText document = document_of(reading, scene);
  if (file->has_more())
    notice(fmt::format("{}: the first frame; animate --frames all shows all", scene));
  return document;
}

bool has_frames(const SceneChoice& choice) {
  const Format* const format = format_of(choice.name);
  return format && format->openness == Openness::atoms;
}

NextFrame read_frames(const SceneChoice& choice, const Overrides& overrides) {
  if (!has_frames(choice))
    throw InputError(
        fmt::format("{}: has no frames; --turntable N goes round any scene", choice.name));
  const std::string& label = choice.name;
  const std::shared_ptr<SceneFile> file =
      naming(label, [&] { return open(*format_of(label), choice, overrides); });
  return [file, label]() -> std::optional<SceneText> {
    const std::optional<Reading> reading = naming(label, [&] { return file->next_frame(); });
    if (!reading) return std::nullopt;
    return document_of(*reading, label);
  };
}

}  // namespace raytracer::client
