// What accuracy costs on one scene, measured: its picture with other settings, each timed and
// compared with a reference that is rendered for it.
//
// Varied are the samples, in single and in double precision, and the target error; and, marked as
// changing the picture, shadows and reflections left out, where the scene has them. The document's
// own samples, contracts and precision count for nothing.
//
// What does not fit into the allowance is left out, as are targets below what the reference can
// tell, and those that are not reached.
//
// Limits: times are those of this machine with all that it does meanwhile, other requests
// included; only tracing is counted, as in Server-Timing. A figure near the reference's own error
// is no better than that.
#pragma once

#include <optional>

#include "engine/parallel/worker_pool.h"
#include "engine/scene/limits.h"
#include "engine/scene/scene.h"
#include "engine/tradeoff/curve.h"
#include "engine/tradeoff/progress.h"

namespace raytracer {

/// Measures for about `most_ms` on the pool's threads; longer only where the least that a curve
/// needs takes longer. Takes no more rays in all than `limits.work`, and no more samples per pixel
/// than `limits.samples`, which allow at least least_curve_samples and least_reference_samples.
/// Nothing if it was stopped.
std::optional<Curve> measure_curve(const Scene& scene, const Limits& limits, double most_ms,
                                   WorkerPool& pool, CurveProgress& progress);

}  // namespace raytracer
