#include "client/formats/meshes/check_ply.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "client/formats/meshes/line_words.h"
#include "client/formats/meshes/ply_bodies.h"
#include "client/formats/meshes/ply_header.h"
#include "client/formats/printable.h"

namespace raytracer::client {
namespace {

/// Whether assimp makes something of elements of that name.
bool is_shown(const PlyElement& element) {
  static constexpr std::array<std::string_view, 3> shown{"vertex", "face", "material"};
  for (const std::string_view name : shown)
    if (element.name == name) return true;
  return false;
}

/// Of a kind that may have been told of.
void add(Reading& reading, Omission more) {
  for (Omission& kind : reading.omissions) {
    if (kind.one != more.one) continue;
    kind.count = static_cast<int>(std::min<std::int64_t>(std::int64_t{kind.count} + more.count,
                                                         std::numeric_limits<int>::max()));
    return;
  }
  reading.omissions.push_back(std::move(more));
}

/// Whether something is made of a property of vertices; an alpha is one without a word, as nearly
/// all are opaque.
bool is_shown(const PlyProperty& property) {
  static constexpr std::array<std::string_view, 10> shown{"x",  "y",   "z",     "nx",   "ny",
                                                          "nz", "red", "green", "blue", "alpha"};
  constexpr std::string_view prefix = "diffuse_";
  std::string_view name = property.name;
  if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  return std::find(shown.begin(), shown.end(), name) != shown.end();
}

void tell_of_properties(const PlyElement& vertex, bool are_points, Reading& reading) {
  const PlyProperty* const radius = are_points ? vertex.radius() : nullptr;
  for (const PlyProperty& property : vertex.properties)
    if (!is_shown(property) && &property != radius)
      reading.omit(property.line, "property of the vertices left out",
                   "properties of the vertices left out");
}

void tell_of(const PlyElement& element, std::optional<PlyBody> body, Reading& reading) {
  if (element.count == 0) return;
  const int count = static_cast<int>(std::min<std::size_t>(element.count, 1U << 30));
  if (!is_shown(element)) {
    const std::string name = element.name == "edge" ? "edge" : "element of another kind";
    const std::string names = element.name == "edge" ? "edges" : "elements of other kinds";
    add(reading, {name + " left out", names + " left out", count, element.line});
  }
  const PlyProperty* const color = element.red();
  if (!color) return;
  if (element.is_face())
    add(reading, {"colour of a face left out", "colours of faces left out", count, color->line});
  if (element.name == "vertex" && !color->type.has_scale() && body != PlyBody::text)
    add(reading, {"colour of a vertex left out, which is neither uchar, ushort nor float",
                  "colours of vertices left out, which are neither uchar, ushort nor float", count,
                  color->line});
}

/// It takes the first element for vertices, and of strips the last triangle.
void require_what_assimp_reads(const PlyHeader& header) {
  for (const PlyElement& element : header.elements) {
    if (element.count == 0 || header.vertex_count() == 0) continue;
    if (element.name == "vertex") break;
    throw LineError{element.line, "the element " + printable(element.name) +
                                      " stands before the vertices, which are to come first"};
  }
  for (const PlyElement& element : header.elements)
    if (element.name == "tristrips" && element.count > 0)
      throw LineError{element.line, "strips of triangles cannot be read: write faces"};
}

}  // namespace

void check_ply(std::string_view bytes, Reading& reading) {
  LineWords words(bytes);
  if (words.next() != "ply") return;
  try {
    const PlyHeader header = read_ply_header(words);
    require_what_assimp_reads(header);
    for (const PlyElement& element : header.elements) tell_of(element, header.body, reading);
    if (header.vertex_count() > 0)
      tell_of_properties(*header.vertex(), header.face_count() == 0, reading);
    if (header.body == PlyBody::text)
      check_ply_text(header, words, reading);
    else if (header.body)
      check_ply_bytes(header, words.rest_of_text(), reading);
  } catch (const LineError& error) {
    reading.errors.push_back(error);
  }
}

}  // namespace raytracer::client
