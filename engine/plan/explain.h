// A plan and its prediction as JSON: for people who look, and for programs.
#pragma once

#include <string>

#include "engine/plan/plan.h"
#include "engine/plan/prediction.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// An object with `features`, `kernel`, `instruction_set`, `precision`, `geometry`, `sampling`,
/// `light_samples` (only where a light is larger than a point), `tiles`, `frame` and `prediction`;
/// choices as {"choice": ..., "reason": "..."}. `precision` also has what its rounding may do at
/// most: `displacement_px` of edges, `levels` of colours. `health` is a list of sentences, empty
/// for a scene that strains nothing. `plan` and `prediction` are the scene's.
std::string explain(const Scene& scene, const Plan& plan, const Prediction& prediction);

}  // namespace raytracer
