// What no structure can hold, because it has no bounds or finds its own parts.
#pragma once

#include "engine/pack/packed_scene.h"

namespace raytracer {

/// Shows a query all that has no bounded place in a structure: squares and planes.
template <typename Query>
void show_unbounded(const PackedScene& scene, Query& query) {
  for (const PackedSquare& square : scene.squares) query.show(square);
  for (const PackedPlane& plane : scene.planes) query.show(plane);
}

}  // namespace raytracer
