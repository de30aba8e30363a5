#include "client/formats/meshes/ply_as_assimp_knows_it.h"

#include <algorithm>
#include <array>
#include <vector>

#include "client/formats/meshes/line_words.h"
#include "client/formats/meshes/ply_header.h"
#include "client/formats/reading.h"

namespace raytracer::client {
namespace {

/// A word of a text, and what is to stand for it.
struct Change {
  std::string_view word;
  std::string_view by;
};

bool is_of_color(std::string_view name) {
  static constexpr std::array<std::string_view, 4> names{"red", "green", "blue", "alpha"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<Change> changes_of_colors(const PlyElement& vertex, bool is_text) {
  constexpr std::string_view prefix = "diffuse_";
  constexpr std::string_view unknown = "unknown";
  std::vector<Change> changes;
  for (const PlyProperty& property : vertex.properties) {
    std::string_view name = property.name;
    if (name.starts_with(prefix) && !vertex.find("red")) name.remove_prefix(prefix.size());
    if (property.count || !is_of_color(name)) continue;
    const bool has_scale = property.type.has_scale();
    if (!has_scale && is_text) changes.push_back({property.type_word, "uchar"});
    if (!has_scale && !is_text) name = unknown;
    if (name != property.name) changes.push_back({property.name, name});
  }
  return changes;
}

/// Of words in their order.
std::string changed(std::string_view text, const std::vector<Change>& changes) {
  std::string result;
  const char* at = text.data();
  for (const Change& change : changes) {
    result.append(at, change.word.data());
    result += change.by;
    at = change.word.data() + change.word.size();
  }
  return result.append(at, text.data() + text.size());
}

/// Whether a line's end is to be written as two characters.
bool ends_ambiguously(std::string_view header, std::string_view body) {
  return body.starts_with('\n') && header.ends_with('\n') && !header.ends_with("\r\n");
}

}  // namespace

std::optional<std::string> ply_as_assimp_knows_it(std::string_view ply) {
  LineWords words(ply);
  if (words.next() != "ply") return std::nullopt;
  try {
    const PlyHeader header = read_ply_header(words);
    if (!header.body) return std::nullopt;
    const bool is_text = header.body == PlyBody::text;
    std::vector<Change> changes;
    if (const PlyElement* const vertex = header.vertex())
      changes = changes_of_colors(*vertex, is_text);
    const std::string_view body = words.rest_of_text();
    const std::string_view before = ply.substr(0, ply.size() - body.size());
    if (!is_text && ends_ambiguously(before, body))
      changes.push_back({before.substr(before.size() - 1), "\r\n"});
    if (changes.empty()) return std::nullopt;
    return changed(ply, changes);
  } catch (const LineError&) {
    return std::nullopt;  // it is said elsewhere
  }
}

}  // namespace raytracer::client
