// The extremes: every document in tests/extremes/scenes, by name.
#pragma once

#include <string>
#include <vector>

#include "engine/engine.h"

namespace raytracer::extremes {

struct Extreme {
  std::string name;
  std::string description;
  Scene scene;
};

/// In the order of their names. Throws std::runtime_error for a document with errors.
std::vector<Extreme> all_extremes();

/// With one sample a pixel.
Image render_as(Scene scene, Precision precision, WorkerPool& pool);

}  // namespace raytracer::extremes
