#include "server/scenes.h"

#include <fmt/format.h>

#include <utility>

#include "server/digest.h"
#include "server/etag.h"
#include "server/problem.h"

namespace raytracer {
namespace {

constexpr std::size_t id_length = 32;

/// In bytes of its text. To read what is shorter takes as long as to look it up, and less than to
/// keep it; that would only push out the texts that take long.
constexpr std::size_t least_cached = 4096;

/// No shipped scene is called like this.
bool is_scene_id(std::string_view name) {
  return name.size() == id_length && name.find_first_not_of("0123456789abcdef") == name.npos;
}

bool is_white_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// A JSON document's text without what lies between its tokens.
std::string without_white_space(std::string_view document) {
  std::string text;
  text.reserve(document.size());
  bool is_in_string = false;
  for (std::size_t i = 0; i < document.size(); ++i) {
    const char c = document[i];
    if (!is_in_string && is_white_space(c)) continue;
    text += c;
    if (is_in_string && c == '\\' && i + 1 < document.size()) text += document[++i];
    if (c == '"') is_in_string = !is_in_string;
  }
  return text;
}

/// What it takes in memory.
std::size_t bytes_of(const KnownScene& known) {
  return sizeof known + memory_bytes(known.scene) + known.content_digest.capacity();
}

}  // namespace

std::optional<std::string> SceneView::picture_digest() const {
  if (scene.render.budget_ms) return {};
  return raytracer::picture_digest(known->content_digest, scene);
}

Scenes::Scenes(const Catalog& catalog, const Limits& limits, std::size_t most_kept,
               std::size_t most_read, Elsewhere elsewhere)
    : catalog_(catalog),
      limits_(limits),
      elsewhere_(std::move(elsewhere)),
      kept_(most_kept),
      read_(most_read) {}

SceneView Scenes::read(const DocumentText& document, const Overrides& overrides,
                       const Limits& limits) {
  if (document.view().size() < least_cached) return parse(document, overrides, limits);
  const std::string text_digest = sha256_hex(document.view());
  if (auto known = read_.find(text_digest)) return view(std::move(known), overrides, limits);
  SceneView read = parse(document, overrides, limits);
  read_.keep(text_digest, read.known, bytes_of(*read.known) + text_digest.size());
  return read;
}

SceneView Scenes::parse(const DocumentText& document, const Overrides& overrides,
                        const Limits& limits) {
  Result<ViewedScene> read = read_viewed_scene(document, limits, overrides);
  if (!read.ok()) throw HttpError(scene_problem(read.errors()));
  auto known = std::make_shared<KnownScene>();
  known->scene = read.value().scene;
  known->content_digest = content_digest(known->scene);
  return {std::move(known), read.value().view};
}

SceneView Scenes::view(std::shared_ptr<const KnownScene> known, const Overrides& overrides,
                       const Limits& limits) {
  Result<Scene> view = view_scene(known->scene, limits, overrides);
  if (!view.ok()) throw HttpError(scene_problem(view.errors()));
  return {std::move(known), view.value()};
}

std::shared_ptr<const KeptScene> Scenes::keep(std::shared_ptr<const KnownScene> known,
                                              std::string document) {
  document.shrink_to_fit();
  const std::size_t bytes = bytes_of(*known) + sizeof(KeptScene) + document.capacity() + id_length;
  std::string id = sha256_hex(without_white_space(document)).substr(0, id_length);
  const auto scene = std::make_shared<const KeptScene>(
      KeptScene{std::move(known), std::move(document), std::move(id), bytes});
  if (kept_.keep(scene->id, scene, bytes)) return scene;
  refuse(413, fmt::format("The scene takes {} bytes in memory, but this server keeps {} in "
                          "all (--max-kept); POST it to /render instead",
                          bytes, kept_.most_bytes()));
}

std::shared_ptr<const KeptScene> Scenes::kept_at(std::string_view id) {
  if (auto scene = kept_.find(id)) return scene;
  if (elsewhere_)
    if (std::optional<std::string> document = elsewhere_(std::string(id))) {
      auto known = parse(*document, {}, limits_).known;
      return keep(std::move(known), *std::move(document));
    }
  refuse(404, fmt::format("There is no scene \"{}\": it was never posted, or was forgotten "
                          "because others needed the memory; POST it to /scenes again",
                          id));
}

SceneView Scenes::at(std::string_view name, const Overrides& overrides) {
  if (is_scene_id(name)) return view(kept_at(name)->known, overrides, limits_);
  return read(catalog_.at(name).document, overrides);
}

std::shared_ptr<const std::string> Scenes::document(std::string_view name) {
  if (!is_scene_id(name)) return std::make_shared<const std::string>(catalog_.at(name).document);
  const std::shared_ptr<const KeptScene> kept = kept_at(name);
  return {kept, &kept->document};
}

}  // namespace raytracer
