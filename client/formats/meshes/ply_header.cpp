#include "client/formats/meshes/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "client/formats/numbers.h"
#include "client/formats/printable.h"
#include "client/formats/reading.h"

namespace raytracer::client {
namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 17> types{{{"char", {1, true}},
                                                                      {"int8", {1, true}},
                                                                      {"uchar", {1, true, false}},
                                                                      {"uint8", {1, true, false}},
                                                                      {"short", {2, true}},
                                                                      {"int16", {2, true}},
                                                                      {"ushort", {2, true, false}},
                                                                      {"uint16", {2, true, false}},
                                                                      {"int", {4, true}},
                                                                      {"int32", {4, true}},
                                                                      {"uint", {4, true, false}},
                                                                      {"uint32", {4, true, false}},
                                                                      {"float", {4, false}},
                                                                      {"float32", {4, false}},
                                                                      {"double", {8, false}},
                                                                      {"float64", {8, false}},
                                                                      {"double64", {8, false}}}};

PlyType type_of(std::string_view word, int line) {
  const auto* const known =
      std::find_if(types.begin(), types.end(), [&](const auto& row) { return row.first == word; });
  if (known == types.end())
    throw LineError{line, fmt::format("{} is no type of PLY; write char, uchar, short, ushort, "
                                      "int, uint, float or double",
                                      quoted(word))};
  return known->second;
}

PlyElement read_element(LineWords& words) {
  PlyElement element{std::string(words.next()), 0, {}, words.line()};
  const std::string_view word = words.next();
  const auto count = count_of(word);
  if (!count)
    throw LineError{words.line(), fmt::format("{} is no number of elements; write element {} N",
                                              quoted(word), printable(element.name))};
  element.count = *count;
  return element;
}

PlyProperty read_property(LineWords& words) {
  const int line = words.line();
  std::string_view word = words.next();
  std::optional<PlyType> count;
  if (word == "list") {
    count = type_of(words.next(), line);
    word = words.next();
  }
  const PlyType type = type_of(word, line);
  return {words.next(), word, type, count, line};
}

std::optional<PlyBody> body_of(std::string_view word) {
  if (word == "ascii") return PlyBody::text;
  if (word == "binary_little_endian") return PlyBody::little_endian;
  if (word == "binary_big_endian") return PlyBody::big_endian;
  return std::nullopt;
}

}  // namespace

const PlyProperty* PlyElement::find(std::string_view property) const {
  const auto found =
      std::find_if(properties.begin(), properties.end(),
                   [&](const PlyProperty& candidate) { return candidate.name == property; });
  return found == properties.end() ? nullptr : &*found;
}

const PlyProperty* PlyElement::red() const {
  const PlyProperty* const plain = find("red");
  return plain ? plain : find("diffuse_red");
}

const PlyProperty* PlyElement::radius() const {
  const bool has_list = std::any_of(properties.begin(), properties.end(),
                                    [](const PlyProperty& property) { return property.count; });
  return has_list ? nullptr : find("radius");
}

const PlyElement* PlyHeader::vertex() const {
  const auto found = std::find_if(elements.begin(), elements.end(), [](const PlyElement& element) {
    return element.name == "vertex";
  });
  return found == elements.end() ? nullptr : &*found;
}

std::size_t PlyHeader::face_count() const {
  std::size_t count = 0;
  for (const PlyElement& element : elements)
    if (element.is_face()) count += element.count;
  return count;
}

bool names_vertices(const PlyElement& element, const PlyProperty& property) {
  return element.is_face() && property.count &&
         (property.name == "vertex_index" || property.name == "vertex_indices");
}

PlyHeader read_ply_header(LineWords& words) {
  PlyHeader header;
  for (words.next_line(); !words.at_end(); words.next_line()) {
    const std::string_view keyword = words.next();
    if (keyword == "format") {
      header.body = body_of(words.next());
    } else if (keyword == "element") {
      header.elements.push_back(read_element(words));
    } else if (keyword == "property") {
      if (header.elements.empty())
        throw LineError{words.line(), "this is a property of no element; write element NAME N"};
      header.elements.back().properties.push_back(read_property(words));
    } else if (keyword == "end_header") {
      words.next_line();
      return header;
    }
  }
  throw LineError{words.line(), "the file ends in its header, which end_header is to end"};
}

std::string plural_of(const PlyElement& element) {
  if (element.name == "vertex") return "vertices";
  return printable(element.name) + "s";
}

}  // namespace raytracer::client
