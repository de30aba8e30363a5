#include "engine/forecast/forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/errors/error_model.h"
#include "engine/forecast/rehearsal.h"
#include "engine/plan/tiles.h"
#include "engine/render/built_scene.h"
#include "engine/render/coarse_picture.h"
#include "engine/sample/refinement.h"
#include "engine/text/pluralised.h"

namespace raytracer {
namespace {

/// What passes over one image take.
struct PassModel {
  const Rehearsal& rehearsal;
  const MachineCosts& costs;
  double coarsest;  ///< the share of the image's pixels that is traced in any case
  double bytes;     ///< likewise
  double threads;   ///< that find a tile to trace

  double pass_ms(double samples) const {
    const double work_ms = bytes * costs.byte_ms + rehearsal.image_ms(samples);
    // Until the others have begun, one thread works alone.
    return std::min(work_ms, (work_ms + (threads - 1) * costs.start_ms) / threads);
  }
};

struct Expectation {
  double samples = 0;
  double trace_ms = 0;
  double error = 0;
};

/// What render() would make of the contract before it chooses pixels: a pilot pass everywhere,
/// under a budget fewer samples before it, as far as there is time.
Expectation expect_pilot(std::optional<double> budget_ms, int pilot, const PassModel& model) {
  const Rehearsal& rehearsal = model.rehearsal;
  Expectation expected;
  const std::array passes = budget_ms
                                ? std::array{1, std::min(RefinementModel::first_step, pilot), pilot}
                                : std::array{pilot, pilot, pilot};
  for (const int samples : passes) {
    if (samples <= expected.samples) continue;
    const double pass_ms = model.pass_ms(samples);
    const double left_ms = budget_ms.value_or(infinity) - expected.trace_ms;
    if (left_ms < pass_ms) {
      const double done = left_ms / pass_ms;
      const double before = expected.samples;
      expected.samples = std::max(before + done * (samples - before), model.coarsest);
      expected.error = before == 0 ? std::min(rehearsal.error_of(expected.samples), 1.0)
                                   : std::hypot(std::sqrt(1 - done) * expected.error,
                                                std::sqrt(done) * rehearsal.error_of(samples));
      expected.trace_ms = std::max(*budget_ms, before == 0 ? model.coarsest * pass_ms : 0);
      return expected;
    }
    expected = {static_cast<double>(samples), expected.trace_ms + pass_ms,
                rehearsal.error_of(samples)};
  }
  return expected;
}

/// The same with what comes after: more samples where they are needed.
Expectation expect_contract(const RenderSettings& settings, std::optional<double> refined_rmse,
                            int most, int pilot, const PassModel& model) {
  const Rehearsal& rehearsal = model.rehearsal;
  const double share = std::min(ForecastModel::blind_factor * rehearsal.refined_share, 1.0);
  const Expectation expected = expect_pilot(settings.budget_ms, pilot, model);
  if (expected.samples < pilot) return expected;
  const double pilot_ms = expected.trace_ms;
  const double sample_ms =
      static_cast<double>(rehearsal.tile_count) * rehearsal.refined_sample_ms / model.threads;

  double even = pilot;  // samples that would err as little as the refined image if all had them
  if (refined_rmse)
    even = std::max(even, std::pow(ForecastModel::error_margin * rehearsal.error / *refined_rmse,
                                   1 / rehearsal.error_exponent));
  // On average: the pixels that are not refined keep theirs.
  double samples = even > pilot ? pilot + share * even : pilot;
  double affordable = most;
  if (settings.budget_ms && sample_ms > 0)
    affordable =
        std::min(affordable, pilot + std::max(*settings.budget_ms - pilot_ms, 0.0) / sample_ms);
  if (samples > affordable || !refined_rmse) {
    samples = affordable;
    even =
        samples > pilot ? std::max(static_cast<double>(pilot), (samples - pilot) / share) : samples;
  }
  const double trace_ms = std::min(pilot_ms + std::max(samples - pilot, 0.0) * sample_ms,
                                   settings.budget_ms.value_or(infinity));
  return {samples, trace_ms, rehearsal.error_of(even)};
}

std::string error_basis(const Rehearsal& rehearsal, double samples) {
  const std::string parts = pluralised(rehearsal.compared, "part") + " of the image";
  if (rehearsal.error == 0)
    return fmt::format("in {} {} samples per pixel showed nothing that one did not", parts,
                       RefinementModel::second_step);
  std::string basis =
      fmt::format("estimated in {} from what {} samples per pixel changed against one", parts,
                  RefinementModel::second_step);
  if (samples < 1) basis += ", and what is not traced is shown by blocks";
  if (samples > 1)
    basis += fmt::format(", where the error fell as samples^-{:.2f}", rehearsal.error_exponent);
  return basis + "; a detail that no sample met is not in it";
}

}  // namespace

std::optional<Forecast> forecast(const Scene& scene, const Limits& limits,
                                 const MachineCosts& costs, WorkerPool& pool,
                                 const RenderProgress& progress) {
  const PreparedScene prepared(scene, pool);
  if (progress.stop) return {};
  const std::optional<Prediction> prediction = predict(prepared, limits, costs, pool, progress);
  if (!prediction) return {};
  return Forecast{prepared.plan(), *prediction};
}

std::optional<Prediction> predict(const PreparedScene& prepared, const Limits& limits,
                                  const MachineCosts& costs, WorkerPool& pool,
                                  const RenderProgress& progress, double pass_limit_ms) {
  const Scene& scene = prepared.scene();
  const Plan& plan = prepared.plan();
  const Rehearsal rehearsal =
      rehearse(scene, prepared.built().tracer, pool, progress, pass_limit_ms);
  if (progress.stop) return {};

  const Camera& camera = scene.camera;
  const bool is_fixed = plan.sampling.value == Sampling::fixed;
  const bool is_one_thread = is_fixed && is_one_tile(scene, scene.render.samples.value_or(1));
  const std::size_t threads =
      is_one_thread ? 1 : std::min(pool.thread_count(), rehearsal.tile_count);
  const double value_bytes = needs_floats(scene) ? sizeof(float) : sizeof(unsigned char);
  const double pixels = camera.pixel_count();
  const PassModel model{rehearsal, costs, coarsest_share(camera.width, camera.height),
                        pixels * channel_count(scene) * value_bytes, static_cast<double>(threads)};
  const double fixed = scene.render.samples.value_or(1);
  const int most = most_samples(scene, limits);
  const Expectation expected =
      plan.sampling.value == Sampling::contract
          ? expect_contract(scene.render, refined_rmse(scene.render, plan.statistics), most,
                            choose_pilot_samples(plan.statistics, most), model)
          : Expectation{fixed, model.pass_ms(fixed), rehearsal.error_of(fixed)};
  return Prediction{
      .build_ms = prepared.build_ms(),
      .trace_ms = expected.trace_ms,
      .samples = expected.samples,
      .error = expected.error,
      .thread_count = pool.thread_count(),
      .basis = fmt::format("measured: the structures were built, and {} of {} parts of the image "
                           "traced, spread over it; for a machine that does nothing else",
                           grouped(rehearsal.timed), grouped(rehearsal.tile_count)),
      .error_basis = error_basis(rehearsal, expected.samples)};
}

}  // namespace raytracer
