// One scene rendered again and again with other settings, within an allowance of time and of rays.
//
// It calls render() as every request does, so that what is measured is what a request gets.
#pragma once

#include <optional>

#include "engine/measure/stopwatch.h"
#include "engine/parallel/worker_pool.h"
#include "engine/render/render.h"
#include "engine/scene/limits.h"
#include "engine/scene/scene.h"
#include "engine/tradeoff/curve.h"
#include "engine/tradeoff/progress.h"

namespace raytracer {

/// A picture, and what it took with all that belongs to it: plan and structures, too.
struct Trial {
  Rendering rendering;
  double call_ms = 0;
};

class Trials {
 public:
  /// `most_ms` is the time for all trials, looked at before each; `limits.work` is kept. All
  /// references must outlive it.
  Trials(const Scene& scene, const Limits& limits, double most_ms, WorkerPool& pool,
         CurveProgress& progress);

  /// Renders with `settings` over the scene's own; nothing if it was stopped. A target that is not
  /// reached ends at `most_samples` per pixel, or with `share` of the allowance.
  std::optional<Trial> render(const CurveSettings& settings, int most_samples, double share);

  /// Whether a picture of so many samples per pixel and milliseconds stays within `share` of the
  /// allowance.
  bool affords(const CurveSettings& settings, double samples, double ms, double share) const;

  const Limits& limits() const { return limits_; }
  CurveProgress& progress() { return progress_; }

 private:
  const Scene& original_;
  Scene scene_;  ///< the same with a trial's settings
  const Limits limits_;
  const double most_ms_;
  const double most_samples_;  ///< per pixel, in all
  WorkerPool& pool_;
  CurveProgress& progress_;
  const Stopwatch watch_{};
  double samples_taken_ = 0;
};

}  // namespace raytracer
