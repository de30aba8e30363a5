#include "engine/render/render.h"

#include <optional>
#include <utility>

#include "engine/image/encode.h"
#include "engine/image/subtile_errors.h"
#include "engine/plan/sampling.h"
#include "engine/render/built_scene.h"
#include "engine/render/refine.h"
#include "engine/render/tracing.h"
#include "engine/sample/error_rules.h"
#include "engine/sample/neighbour_error.h"
#include "engine/sample/pattern.h"
#include "engine/sample/refinement.h"

namespace raytracer {
namespace {

/// Has `trace` do what comes after plan and structures.
template <typename Channel, typename Trace>
BasicRendering<Channel> make_rendering(const BuiltScene& built, WorkerPool& pool,
                                       RenderProgress& progress, const Trace& trace) {
  const Camera& camera = built.scene.camera;
  BasicRendering<Channel> rendering;
  rendering.pixel_count =
      static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  rendering.plan_ms = built.plan_ms;
  rendering.build_ms = built.build_ms;
  rendering.precision = built.plan.precision.value;

  // From here on kernels see packed arrays only.
  Tracing tracing{built, pool, progress};
  trace(tracing, rendering);
  rendering.trace_ms = tracing.watch.elapsed_ms();
  rendering.light_samples = light_samples_of(built.plan, rendering.samples_per_pixel);
  rendering.beyond = tracing.beyond;
  if (rendering.stop == Stop::cancelled) return rendering;
  if (!rendering.estimated_error)
    rendering.estimated_error =
        neighbour_error(rendering.image, built.scene.render.samples.value_or(1));
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
  std::optional<Raster<Channel>> image = tracing.pass<Channel>(
      pattern, {.subtiles = errors ? &*errors : nullptr}, whole_image(camera.width, camera.height));
  rendering.samples_per_pixel = samples;
  rendering.stop = image ? Stop::samples : Stop::cancelled;
  if (!image) return;
  rendering.image = std::move(*image);
  if (!errors) return;
  const double error2 =
      choose_error_multiplier(tracing.plan.statistics).initial * sum_of(errors->all());
  rendering.estimated_error = rms_of(error2, rendering.image.values.size());
}

}  // namespace

Rendering render(const PreparedScene& scene, const Limits& limits, WorkerPool& pool,
                 RenderProgress& progress) {
  return make_rendering<float>(
      scene.built(), pool, progress, [&](Tracing& tracing, Rendering& rendering) {
        if (tracing.plan.sampling.value == Sampling::contract)
          refine_to_contract(most_samples(tracing.scene, limits), tracing, rendering);
        else
          render_fixed(tracing, rendering);
      });
}

ByteRendering render_bytes(const PreparedScene& scene, const Limits& limits, WorkerPool& pool,
                           RenderProgress& progress) {
  if (needs_floats(scene.scene())) {
    Rendering rendering = render(scene, limits, pool, progress);
    return {rendering, to_bytes(rendering.image, pool)};
  }
  return make_rendering<unsigned char>(scene.built(), pool, progress, render_fixed<unsigned char>);
}

Rendering render(const Scene& scene, const Limits& limits, WorkerPool& pool,
                 RenderProgress& progress) {
  return render(PreparedScene(scene, pool), limits, pool, progress);
}

ByteRendering render_bytes(const Scene& scene, const Limits& limits, WorkerPool& pool,
                           RenderProgress& progress) {
  return render_bytes(PreparedScene(scene, pool), limits, pool, progress);
}

}  // namespace raytracer
