#include "client/formats/meshes/obj_numbers.h"

namespace raytracer::client {

std::string with_zeros_before_points(std::string_view obj) {
  std::string text;
  text.reserve(obj.size());
  char before = '\n';
  bool is_vertex = false;
  for (const char c : obj) {
    if (before == '\n') is_vertex = c == 'v';
    if (c == '.' && is_vertex && (before == ' ' || before == '\t')) text += '0';
    text += c;
    before = c;
  }
  return text;
}

}  // namespace raytracer::client
