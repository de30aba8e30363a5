#include "engine/render/refine.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "engine/plan/sampling.h"
#include "engine/render/first_picture.h"
#include "engine/render/refined_image.h"
#include "engine/sample/pattern.h"
#include "engine/sample/refinement.h"

namespace raytracer {
namespace {

/// An edge along a row of pixels must be found, too, which passes all of their samples alike if
/// they have the same places.
SamplePattern pilot_pattern(int samples) {
  return samples > 1 ? jittered_pattern(samples) : sample_pattern(samples);
}

/// The image with the same number of samples in all its pixels: under a budget first what there is
/// time for, and few before many. False if not all of it was done.
bool render_pilot(int samples, Tracing& tracing, RefinedImage& refined) {
  if (!tracing.scene.render.budget_ms) return refined.begin(pilot_pattern(samples));
  std::optional<CoarsePicture> first = trace_first_picture(tracing);
  if (!first) return false;
  const bool is_whole = first->is_at_most(0);
  refined.begin(std::move(*first));
  if (!is_whole || samples == 1) return is_whole;
  constexpr int few = RefinementModel::first_step;
  if (samples > few && !refined.refine_all(pilot_pattern(few))) return false;
  return refined.refine_all(pilot_pattern(samples));
}

}  // namespace

void refine_to_contract(int most_samples, Tracing& tracing, Rendering& rendering) {
  const RenderSettings& settings = tracing.scene.render;
  const double values = static_cast<double>(rendering.pixel_count) * channel_count(tracing.scene);
  const auto squared = [values](std::optional<double> rmse) {
    return rmse ? *rmse * *rmse * values : 0;
  };
  const double allowed2 = squared(settings.target_rmse);
  const double refined2 = squared(refined_rmse(settings, tracing.plan.statistics));
  RefinedImage refined(tracing, rendering.image);
  const int pilot = choose_pilot_samples(tracing.plan.statistics, most_samples);
  bool is_complete = render_pilot(pilot, tracing, refined);
  const bool has_estimate = is_complete && pilot > 1;
  if (has_estimate) refined.look_for_subpixel_objects(pilot);
  constexpr double far_off = 2;  // where a pass that brings little may be the last one needed
  int passes_in_vain = 0;
  while (is_complete && has_estimate && refined.error2() > refined2 &&
         (passes_in_vain < RefinementModel::most_passes_in_vain || settings.budget_ms) &&
         !tracing.is_over_time(refined.choosing_ms())) {
    const double before = refined.error2();
    std::vector<PixelSamples> pixels =
        refined.choose_samples(RefinementModel::aim * refined2, most_samples);
    if (pixels.empty()) break;
    is_complete = refined.refine(std::move(pixels));
    const bool is_in_vain = refined.error2() > RefinementModel::least_fall * before &&
                            refined.error2() > far_off * refined2;
    passes_in_vain = is_in_vain ? passes_in_vain + 1 : 0;
  }
  rendering.samples_per_pixel = refined.mean_samples();
  if (!rendering.image.values.empty())
    rendering.estimated_error = std::sqrt(refined.expected_error2() / values);
  if (tracing.progress.stop)
    rendering.stop = Stop::cancelled;
  else if (has_estimate && settings.target_rmse && refined.error2() <= allowed2)
    rendering.stop = Stop::target;
  else
    rendering.stop = settings.budget_ms ? Stop::budget : Stop::samples;
}

}  // namespace raytracer
