// What the engine will do for a scene, decided once and with its reasons: nothing downstream
// decides it again.
#pragma once

#include <string>

#include "engine/plan/census.h"
#include "engine/plan/frame.h"
#include "engine/plan/machine.h"
#include "engine/plan/precision.h"
#include "engine/plan/structures.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// Which code traces the scene.
enum class Kernel {
  simd,         ///< packets of rays; few spheres and planes, squares of any size
  brute_force,  ///< the reference: one ray at a time against everything
  bvh,          ///< the reference's arithmetic with a tree over spheres and triangles
};

struct Plan {
  Census census;
  Frame frame;
  Choice<Kernel> kernel;
  Choice<Precision> precision;  ///< never automatic
  Structures structures;
  InstructionSet instruction_set;
};

Plan make_plan(const Scene& scene, const Machine& machine);

}  // namespace raytracer
