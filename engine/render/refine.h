// The contracts: an image refined pixel by pixel until its error is small enough or its time over.
//
// Whatever ends it, each pixel shows the best that was made of it: once there is an image it is
// whole, and a pass that was begun is not lost.
#pragma once

#include "engine/render/render.h"
#include "engine/render/tracing.h"

namespace raytracer {

/// Renders under the scene's target_rmse, its budget_ms or both, with at most `most_samples` per
/// pixel, and says in `rendering` what came of it.
void refine_to_contract(int most_samples, Tracing& tracing, Rendering& rendering);

}  // namespace raytracer
