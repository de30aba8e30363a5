// What is wrong with the materials of an OBJ, line by line: assimp names neither the file nor the
// line.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace raytracer::client {

/// What a file of materials says.
struct MaterialLibrary {
  std::set<std::string> names;
  std::vector<std::string> errors;  ///< with its name and the line: "oak.mtl:2: ..."
};

/// `name` is the file's. What it does not know it accepts.
MaterialLibrary check_mtl(std::string_view text, std::string_view name);

/// The name of a material in the rest of a line.
std::string material_name(std::string_view rest);

}  // namespace raytracer::client
