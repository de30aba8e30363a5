// The extremes: every document in tests/extremes/scenes, by name.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "engine/engine.h"

namespace raytracer::extremes {

struct Extreme {
  std::string name;
  std::string description;
  Scene scene;
};

// NOLINTNEXTLINE(readability-identifier-naming): the name that GoogleTest looks for
void PrintTo(const Extreme& extreme, std::ostream* out);

/// In the order of their names. Throws std::runtime_error for a document with errors.
std::vector<Extreme> all_extremes();

/// Likewise, those in tests/extremes/soft, whose light is soft: exact up to the places of lights.
std::vector<Extreme> soft_extremes();

/// With one sample a pixel.
Image render_as(Scene scene, Precision precision, WorkerPool& pool);

}  // namespace raytracer::extremes
