#include "engine/forecast/forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/forecast/rehearsal.h"
#include "engine/measure/stopwatch.h"
#include "engine/plan/counted.h"
#include "engine/sample/contract.h"

namespace raytracer {
namespace {

/// What passes over one image take.
struct PassModel {
  const Rehearsal& rehearsal;
  const MachineCosts& costs;
  double pixels;
  double threads;  ///< that find a tile to trace

  double pass_ms(double samples) const {
    return costs.start_ms + (pixels * costs.pixel_ms + rehearsal.image_ms(samples)) / threads;
  }
};

struct Expectation {
  double samples = 0;
  double trace_ms = 0;
};

/// The passes that render() would make under the contract, each as long and as far off as expected.
Expectation expect_contract(const RenderSettings& settings, int most, const PassModel& model) {
  PassReport last{};
  std::optional<int> samples = first_pass_samples;
  while (samples) {
    if (last.samples > 0) {
      const double ratio = static_cast<double>(*samples) / last.samples;
      // What estimate_error() would make of two images whose errors have nothing in common.
      const double difference =
          std::hypot(model.rehearsal.error_of(last.samples), model.rehearsal.error_of(*samples));
      last.error = difference / (std::sqrt(ratio) - 1);
    }
    last.samples = *samples;
    last.pass_ms = model.pass_ms(*samples);
    last.elapsed_ms += last.pass_ms;
    samples = next_pass(settings, last, most);
  }
  return {static_cast<double>(last.samples), last.elapsed_ms};
}

std::string error_basis(const Rehearsal& rehearsal, double samples) {
  const std::string parts = counted(rehearsal.compared, "part") + " of the image";
  if (rehearsal.error == 0)
    return fmt::format("in {} 16 samples per pixel showed nothing that 1 did not", parts);
  std::string basis =
      fmt::format("estimated from what 16 samples per pixel changed against 1 in {}", parts);
  if (samples > 1)
    basis += fmt::format(", where the error fell as samples^-{:.2f}", rehearsal.error_exponent);
  return basis + "; a detail that no sample met is not in it";
}

}  // namespace

std::optional<Forecast> forecast(const Scene& scene, const Limits& limits,
                                 const MachineCosts& costs, WorkerPool& pool,
                                 const RenderProgress& progress) {
  Forecast result{make_plan(scene, this_machine(pool.thread_count())), {}};
  const Plan& plan = result.plan;
  const Stopwatch build_watch;
  const Tracer tracer = make_tracer(plan, scene, pool);
  const double build_ms = build_watch.elapsed_ms();
  if (progress.stop) return {};
  const Rehearsal rehearsal = rehearse(scene, tracer, pool, progress);
  if (progress.stop) return {};

  const Camera& camera = scene.camera;
  const std::size_t threads = std::min(pool.thread_count(), rehearsal.tile_count);
  const PassModel model{rehearsal, costs, static_cast<double>(camera.width) * camera.height,
                        static_cast<double>(threads)};
  const double fixed = scene.render.samples.value_or(1);
  const Expectation expected =
      plan.sampling.value == Sampling::contract
          ? expect_contract(scene.render, most_samples(scene, limits), model)
          : Expectation{fixed, model.pass_ms(fixed)};
  result.prediction = {
      .build_ms = build_ms,
      .trace_ms = expected.trace_ms,
      .samples = expected.samples,
      .error = rehearsal.error_of(expected.samples),
      .thread_count = pool.thread_count(),
      .basis = fmt::format("measured: the structures were built, and {} of {} parts of the image "
                           "traced, spread over it; for a machine that does nothing else",
                           grouped(rehearsal.timed), grouped(rehearsal.tile_count)),
      .error_basis = error_basis(rehearsal, expected.samples)};
  return result;
}

}  // namespace raytracer
