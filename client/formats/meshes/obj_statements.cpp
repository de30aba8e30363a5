#include "client/formats/meshes/obj_statements.h"

#include <algorithm>
#include <array>
#include <utility>

namespace raytracer::client {
namespace {

/// Those of which files consist come first.
constexpr std::array<std::pair<std::string_view, ObjStatement>, 41> statements{{
    {"v", ObjStatement::vertex},
    {"f", ObjStatement::face},
    {"vt", ObjStatement::texture_place},
    {"vn", ObjStatement::normal},
    {"fo", ObjStatement::face},
    {"l", ObjStatement::line},
    {"p", ObjStatement::point},
    {"g", ObjStatement::name},
    {"o", ObjStatement::name},
    {"s", ObjStatement::name},
    {"usemtl", ObjStatement::material},
    {"mtllib", ObjStatement::material_library},
    {"curv", ObjStatement::curve},
    {"curv2", ObjStatement::curve},
    {"surf", ObjStatement::curve},
    {"bzp", ObjStatement::curve},
    {"bsp", ObjStatement::curve},
    {"cdc", ObjStatement::curve},
    {"cdp", ObjStatement::curve},
    {"vp", ObjStatement::curve_part},
    {"cstype", ObjStatement::curve_part},
    {"deg", ObjStatement::curve_part},
    {"bmat", ObjStatement::curve_part},
    {"step", ObjStatement::curve_part},
    {"parm", ObjStatement::curve_part},
    {"trim", ObjStatement::curve_part},
    {"hole", ObjStatement::curve_part},
    {"scrv", ObjStatement::curve_part},
    {"sp", ObjStatement::curve_part},
    {"end", ObjStatement::curve_part},
    {"con", ObjStatement::curve_part},
    {"res", ObjStatement::curve_part},
    {"mg", ObjStatement::curve_part},
    {"ctech", ObjStatement::curve_part},
    {"stech", ObjStatement::curve_part},
    {"bevel", ObjStatement::display},
    {"c_interp", ObjStatement::display},
    {"d_interp", ObjStatement::display},
    {"lod", ObjStatement::display},
    {"shadow_obj", ObjStatement::display},
    {"trace_obj", ObjStatement::display},
}};

}  // namespace

ObjStatement obj_statement(std::string_view keyword) {
  const auto* const known = std::find_if(statements.begin(), statements.end(),
                                         [&](const auto& row) { return row.first == keyword; });
  return known == statements.end() ? ObjStatement::unknown : known->second;
}

}  // namespace raytracer::client
