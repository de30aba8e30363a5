#include "engine/render/render.h"

#include <cmath>
#include <optional>
#include <utility>

#include "engine/image/encode.h"
#include "engine/image/subtile_errors.h"
#include "engine/kernel/this_machine.h"
#include "engine/measure/stopwatch.h"
#include "engine/plan/plan.h"
#include "engine/plan/sampling.h"
#include "engine/render/refine.h"
#include "engine/render/tracer.h"
#include "engine/render/tracing.h"
#include "engine/sample/error_rules.h"
#include "engine/sample/neighbour_error.h"
#include "engine/sample/pattern.h"
#include "engine/sample/refinement.h"

namespace raytracer {
namespace {

/// Plans and builds, and has `trace` do the rest.
template <typename Channel, typename Trace>
BasicRendering<Channel> make_rendering(const Scene& scene, WorkerPool& pool,
                                       RenderProgress& progress, const Trace& trace) {
  BasicRendering<Channel> rendering;
  rendering.pixel_count =
      static_cast<std::size_t>(scene.camera.width) * static_cast<std::size_t>(scene.camera.height);

  const Stopwatch plan_watch;
  PackedScene packed = pack_scene(scene, &pool);
  const Plan plan = make_plan(scene, packed, this_machine(pool.thread_count()), &pool);
  rendering.plan_ms = plan_watch.elapsed_ms();
  rendering.precision = plan.precision.value;

  const Stopwatch build_watch;
  const Tracer tracer = make_tracer(plan, std::move(packed), pool);
  rendering.build_ms = build_watch.elapsed_ms();

  // From here on kernels see packed arrays only.
  Tracing tracing{tracer, scene, plan, pool, progress, rendering.plan_ms};
  trace(tracing, rendering);
  rendering.trace_ms = tracing.watch.elapsed_ms();
  rendering.beyond = tracing.beyond;
  if (rendering.stop == Stop::cancelled) return rendering;
  if (!rendering.estimated_error)
    rendering.estimated_error = neighbour_error(rendering.image, scene.render.samples.value_or(1));
  progress.fraction = 1;
  return rendering;
}

/// One pass of as many samples as the scene says.
template <typename Channel>
void render_fixed(Tracing& tracing, BasicRendering<Channel>& rendering) {
  const Camera& camera = tracing.scene.camera;
  const int samples = tracing.scene.render.samples.value_or(1);
  const SamplePattern pattern = sample_pattern(samples);
  std::optional<SubtileErrors> errors;
  if (pattern.has_half_buffers()) errors.emplace(camera.width, camera.height);
  std::optional<Raster<Channel>> image =
      tracing.pass<Channel>(pattern, {.subtiles = errors ? &*errors : nullptr});
  rendering.samples_per_pixel = samples;
  rendering.stop = image ? Stop::samples : Stop::cancelled;
  if (!image) return;
  rendering.image = std::move(*image);
  if (!errors) return;
  const double error2 =
      choose_error_multiplier(tracing.plan.statistics).initial * conservative_sum(errors->all());
  rendering.estimated_error =
      std::sqrt(error2 / (3 * static_cast<double>(camera.width) * camera.height));
}

}  // namespace

Rendering render(const Scene& scene, const Limits& limits, WorkerPool& pool,
                 RenderProgress& progress) {
  return make_rendering<float>(scene, pool, progress, [&](Tracing& tracing, Rendering& rendering) {
    if (tracing.plan.sampling.value == Sampling::contract)
      refine_to_contract(most_samples(scene, limits), tracing, rendering);
    else
      render_fixed(tracing, rendering);
  });
}

ByteRendering render_bytes(const Scene& scene, const Limits& limits, WorkerPool& pool,
                           RenderProgress& progress) {
  if (sampling_of(scene.render) == Sampling::contract) {
    Rendering rendering = render(scene, limits, pool, progress);
    return {rendering, to_bytes(rendering.image, pool)};
  }
  return make_rendering<unsigned char>(scene, pool, progress, render_fixed<unsigned char>);
}

}  // namespace raytracer
