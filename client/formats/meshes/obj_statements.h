// The statements of Wavefront's OBJ, by the word with which a line begins.
#pragma once

#include <string_view>

namespace raytracer::client {

enum class ObjStatement {
  vertex,
  texture_place,
  normal,
  face,
  line,
  point,
  name,              ///< of a group or an object; its rest is a text
  material,          ///< its name
  material_library,  ///< a file's name
  curve,             ///< or a surface by equations
  curve_part,        ///< what a curve consists of
  display,           ///< how a program shows it, which is no part of a shape
  unknown
};

/// Of the word with which a line begins.
ObjStatement obj_statement(std::string_view keyword);

}  // namespace raytracer::client
