// What tests of atoms and other particles ask of a file's picture.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/formats/read_text.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {

inline client::ImportOptions options_for(const std::string& color,
                                         client::AtomStyle style = client::AtomStyle::spacefill) {
  client::ImportOptions options;
  options.color = color;
  options.style = style;
  return options;
}

/// How many spheres or cylinders there are.
inline std::size_t count_of(const nlohmann::json& document, const std::string& type) {
  std::size_t count = 0;
  const std::string list = type == "sphere" ? "centers" : "from";
  for (const nlohmann::json& object : document.at("objects")) {
    if (object.at("type") == type) ++count;
    if (object.at("type") == type + "s") count += object.at(list).size();
  }
  return count;
}

/// Of all objects, in the file's order of materials.
inline std::vector<nlohmann::json> centers_of(const nlohmann::json& document) {
  std::vector<nlohmann::json> centers;
  for (const nlohmann::json& object : document.at("objects")) {
    if (object.at("type") == "sphere") centers.push_back(object.at("center"));
    if (object.at("type") == "spheres")
      for (const nlohmann::json& center : object.at("centers")) centers.push_back(center);
  }
  return centers;
}

/// A line of a PDB file.
inline std::string pdb_atom(int serial, const std::string& name, const std::string& residue,
                            char chain, int number, double x, const std::string& element,
                            char alternate = ' ') {
  return fmt::format(
      "HETATM{:5} {:4}{}{:>3} {}{:4}    {:8.3f}   1.000   2.000  0.50{:6.2f}          {:>2}\n",
      serial, name, alternate, residue, chain, number, x, 10.0 + x, element);
}

/// A file of tests/formats/files.
inline std::string shipped(const std::string& name) {
  return read_file(std::filesystem::path(RAYTRACER_SOURCE_DIR) / "tests/formats/files" / name);
}

}  // namespace raytracer::test
