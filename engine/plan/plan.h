// What the engine will do for a scene, decided once and with its reasons.
#pragma once

#include "engine/plan/choice.h"
#include "engine/plan/finders.h"
#include "engine/plan/light_sampling.h"
#include "engine/plan/machine.h"
#include "engine/plan/precision.h"
#include "engine/plan/sampling.h"
#include "engine/plan/scene_statistics.h"
#include "engine/scene/features.h"
#include "engine/scene/scene.h"

namespace raytracer {

struct Plan {
  Features features;
  Frame frame;
  SceneStatistics statistics;
  Choice<Kernel> kernel;
  Choice<Precision> precision;       ///< never automatic
  ArithmeticError arithmetic_error;  ///< in that precision
  Choice<LightSampling> light_sampling;
  FinderTable finders;
  Choice<Sampling> sampling;
  InstructionSet instruction_set;
  Choice<int> tile_side_px;  ///< of the tiles that threads take, in the first pass
};

/// A pure function: the same scene and machine give the same plan. `packed` is the scene's. `pool`:
/// whose threads help with many primitives, if there is one.
Plan make_plan(const Scene& scene, const PackedScene& packed, const Machine& machine,
               WorkerPool* pool = nullptr);

/// The places of each soft light that a pixel with so many samples, or in their mean, looks at; 0
/// if there is none.
int light_samples_of(const Plan& plan, double samples);

}  // namespace raytracer
