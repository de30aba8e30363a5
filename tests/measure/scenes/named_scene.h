// The scenes that are measured, by name: those made here, the shipped ones, and any file.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/engine.h"

namespace raytracer::measure {

struct NamedScene {
  std::string name;
  std::function<std::string()> document;
};

/// Those made here, from fixed seeds.
std::vector<NamedScene> made_scenes();

/// Those in the folder `shipped`, by name.
std::vector<NamedScene> shipped_scenes(const std::string& shipped);

/// The one that is made here, shipped or in a file of this name, tried in that order.
/// Throws std::runtime_error where there is none.
NamedScene find_scene(const std::string& name, const std::string& shipped);

/// Throws std::runtime_error with the first error if the document is refused.
Scene read_document(std::string_view document, const Overrides& overrides);

}  // namespace raytracer::measure
