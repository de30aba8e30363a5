// What is measured: scenes, some in more than one size or with more than one sample.
#pragma once

#include <string>
#include <vector>

#include "engine/engine.h"
#include "tests/measure/scenes/named_scene.h"

namespace raytracer::bench {

struct Case {
  measure::NamedScene scene;
  Overrides view{};       ///< size and samples, where they are not the document's
  bool is_quick = false;  ///< a second or so for all together

  /// "reflections, 3840 x 2160, 16 samples", the document's own left out.
  std::string name() const;
};

/// Those that are measured where no scene is named.
std::vector<Case> standard_cases(const std::string& shipped);

}  // namespace raytracer::bench
