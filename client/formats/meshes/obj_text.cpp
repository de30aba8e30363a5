#include "client/formats/meshes/obj_text.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>

#include "client/formats/meshes/line_words.h"
#include "client/formats/meshes/obj_statements.h"
#include "client/formats/numbers.h"

namespace raytracer::client {
namespace {

/// The vertices of an OBJ, of which some may have colours.
struct VertexColors {
  bool are_wanted = false;  ///< of all of them: white where there is none
  bool some_have = false;
  bool some_lack = false;
};

/// The words of a vertex's place, by the fourth number, which divides it.
std::string divided(std::string_view number, std::string_view by) {
  return fmt::format(" {}", number_of(number).value_or(0) / number_of(by).value_or(1));
}

/// Of a vertex with more numbers than assimp knows the place, and the colour without its alpha.
void write_vertex(LineWords& words, VertexColors& colors, std::string& text) {
  constexpr std::size_t with_color = 6;
  constexpr std::size_t homogeneous = 4;
  std::array<std::string_view, with_color> numbers;
  std::size_t count = 0;
  for (auto word = words.next(); !word.empty(); word = words.next(), ++count)
    if (count < with_color) numbers[count] = word;
  if (count > homogeneous) count = count < with_color ? 3 : with_color;
  (count == with_color ? colors.some_have : colors.some_lack) = true;
  const bool whitens = colors.are_wanted && count != with_color;
  const bool divides = whitens && count == homogeneous;
  for (std::size_t i = 0; i < (divides ? 3 : count); ++i) {
    if (divides) {
      text += divided(numbers[i], numbers[3]);
      continue;
    }
    text += numbers[i][0] == '.' ? " 0" : " ";
    text += numbers[i];
  }
  if (whitens) text += " 1 1 1";
}

void write_numbers(LineWords& words, ObjStatement statement, std::string& text) {
  const bool are_shares =
      statement == ObjStatement::normal || statement == ObjStatement::texture_place;
  int count = 0;
  for (auto word = words.next(); !word.empty(); word = words.next(), ++count) {
    text += are_shares && word[0] == '.' ? " 0" : " ";
    text += word;
  }
  if (statement == ObjStatement::texture_place && count == 1) text += " 0";
}

std::string written(std::string_view obj, VertexColors& colors) {
  std::string text;
  text.reserve(obj.size());
  for (LineWords words(obj, true); !words.at_end(); words.next_line()) {
    const std::string_view keyword = words.next();
    if (keyword.empty()) continue;
    switch (const ObjStatement statement = obj_statement(keyword)) {
      case ObjStatement::vertex:
        text += keyword;
        write_vertex(words, colors, text);
        break;
      case ObjStatement::texture_place:
      case ObjStatement::normal:
      case ObjStatement::face:
      case ObjStatement::point:
        text += keyword;
        write_numbers(words, statement, text);
        break;
      case ObjStatement::name:
      case ObjStatement::material:
      case ObjStatement::material_library:
        text += keyword;
        text += ' ';
        text += words.rest();
        break;
      case ObjStatement::line:
      case ObjStatement::curve:
      case ObjStatement::curve_part:
      case ObjStatement::display:
      case ObjStatement::unknown:
        continue;
    }
    text += '\n';
  }
  return text;
}

}  // namespace

std::string obj_as_assimp_knows_it(std::string_view obj) {
  VertexColors colors;
  std::string text = written(obj, colors);
  if (!colors.some_have || !colors.some_lack) return text;
  colors.are_wanted = true;
  return written(obj, colors);
}

}  // namespace raytracer::client
