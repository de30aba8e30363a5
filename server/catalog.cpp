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

}  // namespace

SceneDescription describe(const ShippedScene& scene) try {
  const auto document = nlohmann::json::parse(scene.document);
  const auto& camera = document.at("camera");
  return {document.at("name"), document.at("description"), camera.at("width"), camera.at("height")};
} catch (const nlohmann::json::exception& error) {
  throw std::logic_error(fmt::format("{}: {}", scene.name, error.what()));
}

Catalog::Catalog() {
  for (const EmbeddedFile& file : embedded_files()) {
    if (!file.path.starts_with(folder)) continue;
    std::string_view name = file.path.substr(folder.size());
    name.remove_suffix(ending.size());
    scenes_.push_back({std::string(name), file.bytes});
  }
}

const ShippedScene& Catalog::at(std::string_view name) const {
  std::vector<std::string_view> names;
  for (const ShippedScene& scene : scenes_) {
    if (scene.name == name) return scene;
    names.push_back(scene.name);
  }
  const std::string slip = did_you_mean(name, names);
  refuse(404, fmt::format("There is no scene \"{}\"{} GET /scenes lists them", name,
                          slip.empty() ? ":" : slip));
}

}  // namespace raytracer
