#include "engine/render/refine.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "engine/plan/sampling.h"
#include "engine/render/first_picture.h"
#include "engine/render/refined_image.h"
#include "engine/sample/refinement.h"

namespace raytracer {
namespace {

/// The squared error to aim at, of what is sought: a bound that is just missed costs one more
/// pass.
constexpr double aim = 0.9;

/// Before any pixel is chosen, an edge along a row of pixels must be found, too, which passes all
/// of their samples alike if they have the same places.
SamplePattern probing_pattern(int samples) {
  return samples > 1 ? staggered_pattern(samples) : sample_pattern(samples);
}

/// The image with the same number of samples in all its pixels: under a budget first what there is
/// time for. False if not all of it was done.
bool probe(int samples, Tracing& tracing, RefinedImage& refined) {
  if (!tracing.scene.render.budget_ms) return refined.begin(probing_pattern(samples));
  std::optional<FirstPicture> first = trace_first_picture(tracing);
  if (!first) return false;
  const bool is_whole = first->is_whole;
  refined.begin(std::move(*first));
  // Few samples first: they have a chance to be done.
  constexpr int few = 4;
  if (!is_whole || samples == 1) return is_whole;
  if (samples > few && !refined.refine_all(probing_pattern(few))) return false;
  return refined.refine_all(probing_pattern(samples));
}

}  // namespace

void refine_to_contract(int most_samples, Tracing& tracing, Rendering& rendering) {
  const RenderSettings& settings = tracing.scene.render;
  const double values = static_cast<double>(rendering.pixel_count) * 3;
  const auto squared = [values](std::optional<double> rmse) {
    return rmse ? *rmse * *rmse * values : 0;
  };
  const double allowed2 = squared(settings.target_rmse);
  const double sought2 = squared(sought_rmse(settings, tracing.plan.census));
  RefinedImage refined(tracing, rendering.image);
  const int samples_everywhere = first_compared_samples(tracing.plan.census, most_samples);
  bool is_complete = probe(samples_everywhere, tracing, refined);
  const bool is_compared = is_complete && samples_everywhere > 1;
  if (is_compared) refined.look_for_missable_spheres();
  while (is_complete && is_compared && refined.error2() > sought2 && !tracing.is_over_time()) {
    std::vector<PixelSamples> pixels = refined.next_samples(aim * sought2, most_samples);
    if (pixels.empty()) break;
    is_complete = refined.refine(std::move(pixels));
  }
  rendering.samples_per_pixel = refined.mean_samples();
  const double error2 = refined.error2();
  if (!rendering.image.values.empty()) rendering.estimated_error = std::sqrt(error2 / values);
  if (tracing.progress.stop)
    rendering.stop = Stop::cancelled;
  else if (is_compared && settings.target_rmse && error2 <= allowed2)
    rendering.stop = Stop::target;
  else
    rendering.stop = settings.budget_ms ? Stop::budget : Stop::samples;
}

}  // namespace raytracer
