#include "tests/measure/tradeoff/exact_picture.h"

#include <limits>
#include <optional>
#include <utility>

#include "engine/tradeoff/reference.h"
#include "engine/tradeoff/trials.h"

namespace raytracer::published {

Rendering render_with(const Scene& scene, const Overrides& overrides, WorkerPool& pool) {
  RenderProgress progress;
  return render(with_overrides(scene, overrides), Limits{}, pool, progress);
}

ExactPicture render_exactly(const Scene& scene, int samples, WorkerPool& pool) {
  Limits limits;
  limits.samples = samples;
  limits.work = std::numeric_limits<std::int64_t>::max();
  constexpr double most_ms = 1e9;        // the number of samples ends it, or the error
  constexpr double wanted_error = 3e-5;  // far below all that is measured by it
  RenderProgress picture;
  CurveProgress progress(picture);
  Trials trials(scene, limits, most_ms, pool, progress);
  std::optional<Reference> reference = render_reference(trials, wanted_error, 1);
  return {std::move(reference->image), *reference->description.settings.samples,
          reference->description.estimated_error};
}

}  // namespace raytracer::published
