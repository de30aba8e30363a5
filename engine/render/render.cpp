#include "engine/render/render.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

#include "engine/image/encode.h"
#include "engine/image/tile.h"
#include "engine/measure/stopwatch.h"
#include "engine/plan/plan.h"
#include "engine/plan/sampling.h"
#include "engine/plan/tiles.h"
#include "engine/render/tracer.h"
#include "engine/sample/contract.h"
#include "engine/sample/pattern.h"

namespace raytracer {
namespace {

/// A scene made ready, and what every pass over the image needs.
struct Tracing {
  const Tracer& tracer;
  const Scene& scene;
  WorkerPool& pool;
  RenderProgress& progress;
  int passes_done = 0;
  Stopwatch watch{};

  bool is_over_time() const {
    const std::optional<double>& budget_ms = scene.render.budget_ms;
    return budget_ms && watch.elapsed_ms() > *budget_ms;
  }

  /// An image of `samples` per pixel; nothing if it was stopped before it was whole. A pass that
  /// `may_end_early` is also stopped when the time is over.
  template <typename Channel>
  std::optional<Raster<Channel>> pass(int samples, bool may_end_early) {
    Raster<Channel> image(scene.camera.width, scene.camera.height);
    const std::vector<SamplePoint> pattern = sample_pattern(samples);
    const std::vector<Tile> tiles = split_into_tiles(
        image.width, image.height,
        tile_side_px(image.width, image.height, samples, scene.lights.size(), pool.thread_count()));
    std::atomic<bool> stop{progress.stop.load()};
    std::atomic<std::size_t> done{0};
    std::optional<Preview::Pass> preview;
    if constexpr (std::is_same_v<Channel, float>) preview.emplace(progress.preview, image, tiles);
    const auto trace = [&](std::size_t i) {
      if (progress.stop || (may_end_early && is_over_time())) {
        stop = true;
        return;
      }
      render_tile(tracer, pattern, scene.render.transfer, tiles[i], &image);
      if (preview) preview->finished(i);
      report(static_cast<double>(++done) / static_cast<double>(tiles.size()));
    };
    if (is_one_tile(image.width, image.height, samples, scene.lights.size()))
      trace(0);
    else
      pool.run(tiles.size(), trace, stop);
    preview.reset();  // before the image moves
    if (stop) return {};
    ++passes_done;
    return image;
  }

  /// Under a budget progress is the time's. Under a target alone nobody knows how many passes will
  /// follow: each takes half of what those before have left.
  void report(double pass_fraction) {
    double fraction = pass_fraction;
    if (scene.render.budget_ms)
      fraction = std::min(1.0, watch.elapsed_ms() / *scene.render.budget_ms);
    else if (scene.render.target_rmse)
      fraction = 1 - std::ldexp(1 - pass_fraction / 2, -passes_done);
    double before = progress.fraction;
    while (before < fraction && !progress.fraction.compare_exchange_weak(before, fraction)) {
    }
  }
};

/// Passes of ever more samples, until next_pass says that the contract is kept.
void render_by_contract(int most, Tracing& tracing, Rendering& rendering) {
  const RenderSettings& settings = tracing.scene.render;
  PassReport last{};
  Preview::Whole whole(tracing.progress.preview, rendering.image);
  std::optional<int> samples = first_pass_samples;
  while (samples) {
    std::optional<Image> image = tracing.pass<float>(*samples, last.samples > 0);
    if (!image) break;
    if (last.samples > 0)
      last.error =
          estimate_error(rendering.image, *image, static_cast<double>(*samples) / last.samples);
    last.samples = *samples;
    const double elapsed_ms = tracing.watch.elapsed_ms();
    last.pass_ms = elapsed_ms - last.elapsed_ms;
    last.elapsed_ms = elapsed_ms;
    whole.replace(std::move(*image));
    rendering.samples_per_pixel = last.samples;
    rendering.estimated_error = last.error;
    samples = next_pass(settings, last, most);
  }
  if (tracing.progress.stop)
    rendering.stop = Stop::cancelled;
  else if (settings.target_rmse && last.error && *last.error <= *settings.target_rmse)
    rendering.stop = Stop::target;
  else
    rendering.stop = settings.budget_ms ? Stop::budget : Stop::samples;
}

/// Plans and builds, and has `trace` do the rest.
template <typename Channel, typename Trace>
BasicRendering<Channel> make_rendering(const Scene& scene, WorkerPool& pool,
                                       RenderProgress& progress, const Trace& trace) {
  BasicRendering<Channel> rendering;
  rendering.pixel_count =
      static_cast<std::size_t>(scene.camera.width) * static_cast<std::size_t>(scene.camera.height);

  const Stopwatch plan_watch;
  const Plan plan = make_plan(scene, this_machine(pool.thread_count()));
  rendering.plan_ms = plan_watch.elapsed_ms();
  rendering.precision = plan.precision.value;

  const Stopwatch build_watch;
  const Tracer tracer = make_tracer(plan, scene, pool);
  rendering.build_ms = build_watch.elapsed_ms();

  // From here on kernels see packed arrays only.
  Tracing tracing{tracer, scene, pool, progress};
  trace(tracing, rendering);
  rendering.trace_ms = tracing.watch.elapsed_ms();
  if (rendering.stop != Stop::cancelled) progress.fraction = 1;
  return rendering;
}

/// One pass of as many samples as the scene says.
template <typename Channel>
void render_fixed(Tracing& tracing, BasicRendering<Channel>& rendering) {
  const int samples = tracing.scene.render.samples.value_or(1);
  std::optional<Raster<Channel>> image = tracing.pass<Channel>(samples, false);
  rendering.samples_per_pixel = samples;
  rendering.stop = image ? Stop::samples : Stop::cancelled;
  if (image) rendering.image = std::move(*image);
}

}  // namespace

Rendering render(const Scene& scene, const Limits& limits, WorkerPool& pool,
                 RenderProgress& progress) {
  return make_rendering<float>(scene, pool, progress, [&](Tracing& tracing, Rendering& rendering) {
    if (sampling_of(scene.render) == Sampling::contract)
      render_by_contract(most_samples(scene, limits), tracing, rendering);
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
