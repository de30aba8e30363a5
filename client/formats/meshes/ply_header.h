// The header of a PLY: the elements of which the rest of the file has so and so many, and their
// properties.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/formats/meshes/line_words.h"

namespace raytracer::client {

struct PlyType {
  std::size_t bytes;
  bool is_integer;
  bool is_signed = true;

  /// Whether a colour's number says how bright it is: others have no greatest one that means white.
  bool has_scale() const { return !is_integer || (!is_signed && bytes <= 2); }
};

/// The words are those in the text of the file.
struct PlyProperty {
  std::string_view name;
  std::string_view type_word;
  PlyType type;
  std::optional<PlyType> count;  ///< of a list
  int line;
};

struct PlyElement {
  std::string name;
  std::size_t count;
  std::vector<PlyProperty> properties;
  int line;

  bool is_face() const { return name == "face"; }
  /// Null if it has none.
  const PlyProperty* find(std::string_view property) const;
  /// That tells how red each is, under either of its names; null if none does.
  const PlyProperty* red() const;
  /// Of points, if each property is one number; null if there is none.
  const PlyProperty* radius() const;
};

enum class PlyBody { text, little_endian, big_endian };

struct PlyHeader {
  std::optional<PlyBody> body;  ///< nothing if it is no known one
  std::vector<PlyElement> elements;

  /// Null if there are none.
  const PlyElement* vertex() const;
  std::size_t face_count() const;
  std::size_t vertex_count() const { return vertex() ? vertex()->count : 0; }
};

/// Whether the words in a PLY's property are those of corners.
bool names_vertices(const PlyElement& element, const PlyProperty& property);

/// Of a text that begins with "ply"; the words then stand at the line behind it. Throws LineError.
PlyHeader read_ply_header(LineWords& words);

/// "vertices" of a vertex.
std::string plural_of(const PlyElement& element);

}  // namespace raytracer::client
