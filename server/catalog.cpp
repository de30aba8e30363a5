#include "server/catalog.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "engine/engine.h"
#include "server/embedded.h"
#include "server/problem.h"

namespace raytracer {
namespace {

constexpr std::string_view folder = "scenes/";
constexpr std::string_view ending = ".json";

ShippedScene describe(const EmbeddedFile& file) try {
  const auto document = nlohmann::json::parse(file.bytes);
  std::string_view name = file.path.substr(folder.size());
  name.remove_suffix(ending.size());
  return {std::string(name),
          document.at("name"),
          document.at("description"),
          document.at("camera").at("width"),
          document.at("camera").at("height"),
          file.bytes};
} catch (const nlohmann::json::exception& error) {
  throw std::logic_error(fmt::format("{}: {}", file.path, error.what()));
}

}  // namespace

Catalog::Catalog() {
  for (const EmbeddedFile& file : embedded_files())
    if (file.path.starts_with(folder)) scenes_.push_back(describe(file));
}

const ShippedScene& Catalog::at(std::string_view name) const {
  std::vector<std::string_view> names;
  for (const ShippedScene& scene : scenes_) {
    if (scene.name == name) return scene;
    names.push_back(scene.name);
  }
  refuse(404, fmt::format("There is no scene \"{}\"; did you mean \"{}\"? GET /scenes "
                          "lists them",
                          name, nearest_key(name, names)));
}

}  // namespace raytracer
