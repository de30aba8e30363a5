// The eye on its way round a scene.
#pragma once

#include <array>

#include "client/scene_text.h"

namespace raytracer::client {

/// The camera of a document: where it stands and what it looks at.
struct Orbit {
  std::array<double, 3> origin;
  std::array<double, 3> look_at;
  std::array<double, 3> up;

  /// For a query: the camera after `share` of a whole turn about the axis through what it looks at.
  Overrides at(double share) const;
};

/// Throws InputError if the document has no camera that can be read.
Orbit orbit_of(const SceneText& scene);

}  // namespace raytracer::client
