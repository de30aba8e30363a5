#include "engine/tradeoff/trials.h"

#include <algorithm>
#include <utility>

#include "engine/scene/work.h"

namespace raytracer {
namespace {

/// How many samples it takes to end with an image of `samples`: a target's earlier passes have
/// together not even half as many.
double with_earlier_passes(const CurveSettings& settings, double samples) {
  return settings.target_rmse ? 1.5 * samples : samples;
}

}  // namespace

Trials::Trials(const Scene& scene, const Limits& limits, double most_ms, WorkerPool& pool,
               CurveProgress& progress)
    : original_(scene),
      scene_(scene),
      limits_(limits),
      most_ms_(most_ms),
      most_samples_(static_cast<double>(limits.work) / work_of(scene, 1)),
      pool_(pool),
      progress_(progress) {}

std::optional<Trial> Trials::render(const CurveSettings& settings, int most_samples, double share) {
  RenderSettings& asked = scene_.render;
  asked = original_.render;
  asked.samples = settings.samples;
  asked.target_rmse = settings.target_rmse;
  asked.budget_ms.reset();
  asked.precision = settings.precision;
  if (settings.without_reflections) asked.max_depth = 0;
  scene_.shadows = settings.without_shadows ? Shadows::off : original_.shadows;

  Limits limits = limits_;
  if (settings.target_rmse) {
    asked.budget_ms = std::max(1.0, share * most_ms_ - watch_.elapsed_ms());
    const double left = (share * most_samples_ - samples_taken_) / with_earlier_passes(settings, 1);
    limits.samples = std::max<std::int64_t>(
        1, std::min({limits.samples, std::int64_t{most_samples}, static_cast<std::int64_t>(left)}));
    // A refinement may be cut to these, in fours. No reference has so many (reference.h).
    if (limits.samples >= 8 && limits.samples / 4 % 5 == 0) limits.samples -= 4;
  }
  const Stopwatch watch;
  Rendering rendering = raytracer::render(scene_, limits, pool_, progress_.picture());
  if (rendering.stop == Stop::cancelled || progress_.is_stopped()) return {};
  samples_taken_ += with_earlier_passes(settings, rendering.samples_per_pixel);
  return Trial{std::move(rendering), watch.elapsed_ms()};
}

bool Trials::affords(const CurveSettings& settings, double samples, double ms, double share) const {
  return samples_taken_ + with_earlier_passes(settings, samples) <= share * most_samples_ &&
         watch_.elapsed_ms() + ms <= share * most_ms_;
}

}  // namespace raytracer
