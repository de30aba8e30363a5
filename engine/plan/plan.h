// What the engine will do for a scene, decided once and with its reasons: nothing downstream
// decides it again.
#pragma once

#include <vector>

#include "engine/plan/census.h"
#include "engine/plan/choice.h"
#include "engine/plan/features.h"
#include "engine/plan/frame.h"
#include "engine/plan/machine.h"
#include "engine/plan/precision.h"
#include "engine/plan/sampling.h"
#include "engine/plan/structures.h"
#include "engine/scene/scene.h"

namespace raytracer {

struct Plan {
  Features features;
  Frame frame;
  Census census;
  Choice<Kernel> kernel;
  Choice<Precision> precision;       ///< never automatic
  ArithmeticError arithmetic_error;  ///< in that precision
  Structures structures;
  Choice<Sampling> sampling;
  InstructionSet instruction_set;
  Choice<int> tile_side_px;  ///< of the tiles that threads take, in the first pass
};

/// A pure function: the same scene and machine give the same plan. `pool`: as for take_census().
Plan make_plan(const Scene& scene, const Machine& machine, WorkerPool* pool = nullptr);

}  // namespace raytracer
