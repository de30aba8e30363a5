// A render predicted: its plan, and what it will take and give.
//
//   work of a pass = bytes * memory for one + tiles * time of one
//   its time = (work + (threads - 1) * start) / threads, or the work if that is less
//
// What a start and memory cost belongs to the machine and is measured once; what a tile takes
// belongs to the scene and comes from a rehearsal.
#pragma once

#include <optional>

#include "engine/errors/error_model.h"
#include "engine/forecast/machine_costs.h"
#include "engine/parallel/worker_pool.h"
#include "engine/plan/plan.h"
#include "engine/plan/prediction.h"
#include "engine/render/prepared_scene.h"
#include "engine/render/progress.h"
#include "engine/scene/limits.h"
#include "engine/scene/scene.h"

namespace raytracer {

struct Forecast {
  Plan plan;
  Prediction prediction;
};

/// Traces a part of what the render would trace, on the pool's threads. Nothing if `progress.stop`
/// ended it. `limits` bounds the samples that a contract may spend; `pass_limit_ms` as for
/// rehearse().
std::optional<Prediction> predict(const PreparedScene& prepared, const Limits& limits,
                                  const MachineCosts& costs, WorkerPool& pool,
                                  const RenderProgress& progress,
                                  double pass_limit_ms = ForecastModel::pass_limit_ms);

/// The same, after it has built what the render would build.
std::optional<Forecast> forecast(const Scene& scene, const Limits& limits,
                                 const MachineCosts& costs, WorkerPool& pool,
                                 const RenderProgress& progress);

}  // namespace raytracer
