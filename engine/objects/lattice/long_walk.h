// The end of a walk over a lattice's cells that has become long.
//
// A ray between two rows of spheres, or just under their tops, can pass more cells than there is
// time for. After some steps its lane is handed to the reference, which takes a row in one step.
#pragma once

#include <optional>

#include "engine/math/vec.h"

namespace raytracer {

/// A ray and a lattice in the lattice's axes (first, across, second) and cells.
struct LongWalk {
  Vec3 origin;
  Vec3 direction;  ///< unit
  double low_first;
  double low_second;
  double side;  ///< cells along a side
  double own_first;
  double own_second;
  bool leaves_own;  ///< whether the ray leaves the sphere in the cell (own_first, own_second)
};

struct LongWalkHit {
  double t;
  double first;
  double second;
};

/// The nearest sphere met at t > 0.
std::optional<LongWalkHit> finish_walk(const LongWalk& walk);

}  // namespace raytracer
