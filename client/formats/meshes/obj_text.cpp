#include "client/formats/meshes/obj_text.h"

#include <array>
#include <cstddef>

#include "client/formats/meshes/line_words.h"
#include "client/formats/meshes/obj_statements.h"

namespace raytracer::client {
namespace {

/// Of a vertex with more numbers than assimp knows the place, and the colour without its alpha.
void write_vertex(LineWords& words, std::string& text) {
  constexpr std::size_t with_color = 6;
  constexpr std::size_t homogeneous = 4;
  std::array<std::string_view, with_color> numbers;
  std::size_t count = 0;
  for (auto word = words.next(); !word.empty(); word = words.next(), ++count)
    if (count < with_color) numbers[count] = word;
  if (count > homogeneous) count = count < with_color ? 3 : with_color;
  for (std::size_t i = 0; i < count; ++i) {
    text += numbers[i][0] == '.' ? " 0" : " ";
    text += numbers[i];
  }
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

}  // namespace

std::string obj_as_assimp_knows_it(std::string_view obj) {
  std::string text;
  text.reserve(obj.size());
  for (LineWords words(obj, true); !words.at_end(); words.next_line()) {
    const std::string_view keyword = words.next();
    if (keyword.empty()) continue;
    switch (const ObjStatement statement = obj_statement(keyword)) {
      case ObjStatement::vertex:
        text += keyword;
        write_vertex(words, text);
        break;
      case ObjStatement::texture_place:
      case ObjStatement::normal:
      case ObjStatement::face:
      case ObjStatement::point:
        text += keyword;
        write_numbers(words, statement, text);
        break;
      case ObjStatement::name:
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

}  // namespace raytracer::client
