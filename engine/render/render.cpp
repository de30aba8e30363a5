#include "engine/render/render.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/image/tile.h"
#include "engine/measure/stopwatch.h"
#include "engine/plan/plan.h"
#include "engine/plan/tiles.h"
#include "engine/render/tracer.h"
#include "engine/sample/contract.h"
#include "engine/sample/pattern.h"

namespace raytracer {
namespace {

/// What every pass over the image needs.
struct Tracing {
  const Tracer& tracer;
  int width;
  int height;
  Transfer transfer;
  std::size_t light_count;
  WorkerPool& pool;
  RenderProgress& progress;
  std::optional<double> budget_ms;
  bool is_contract;
  int passes_done = 0;
  Stopwatch watch{};

  bool is_over_time() const { return budget_ms && watch.elapsed_ms() > *budget_ms; }

  /// An image of `samples` per pixel; nothing if it was stopped before it was whole. A pass that
  /// `may_end_early` is also stopped when the time is over.
  std::optional<Image> pass(int samples, bool may_end_early) {
    Image image(width, height);
    const std::vector<SamplePoint> pattern = sample_pattern(samples);
    const std::vector<Tile> tiles = split_into_tiles(
        image.width, image.height,
        tile_side_px(image.width, image.height, samples, light_count, pool.thread_count()));
    std::atomic<bool> stop{progress.stop.load()};
    std::atomic<std::size_t> done{0};
    std::optional<Preview::Pass> preview(std::in_place, progress.preview, image, tiles);
    pool.run(
        tiles.size(),
        [&](std::size_t i) {
          if (progress.stop || (may_end_early && is_over_time())) {
            stop = true;
            return;
          }
          render_tile(tracer, pattern, transfer, tiles[i], image);
          preview->finished(i);
          report(static_cast<double>(++done) / static_cast<double>(tiles.size()));
        },
        stop);
    preview.reset();  // before the image moves
    if (stop) return {};
    ++passes_done;
    return image;
  }

  /// Under a budget progress is the time's. Under a target alone nobody knows how many passes will
  /// follow: each takes half of what those before have left.
  void report(double pass_fraction) {
    double fraction = pass_fraction;
    if (budget_ms)
      fraction = std::min(1.0, watch.elapsed_ms() / *budget_ms);
    else if (is_contract)
      fraction = 1 - std::ldexp(1 - pass_fraction / 2, -passes_done);
    double before = progress.fraction;
    while (before < fraction && !progress.fraction.compare_exchange_weak(before, fraction)) {
    }
  }
};

/// Passes of ever more samples, until next_pass says that the contract is kept.
void render_by_contract(const RenderSettings& settings, int most, Tracing& tracing,
                        Rendering& rendering) {
  PassReport last{};
  Preview::Whole whole(tracing.progress.preview, rendering.image);
  std::optional<int> samples = first_pass_samples;
  while (samples) {
    std::optional<Image> image = tracing.pass(*samples, last.samples > 0);
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

}  // namespace

Rendering render(const Scene& scene, const Limits& limits, WorkerPool& pool,
                 RenderProgress& progress) {
  Rendering rendering;

  const Stopwatch plan_watch;
  const Plan plan = make_plan(scene, this_machine(pool.thread_count()));
  rendering.plan_ms = plan_watch.elapsed_ms();
  rendering.precision = plan.precision.value;

  const Stopwatch build_watch;
  const Tracer tracer = make_tracer(plan, scene, pool);
  rendering.build_ms = build_watch.elapsed_ms();

  // From here on the scene is not looked at: kernels see packed arrays only.
  const RenderSettings& settings = scene.render;
  const bool is_contract = plan.sampling.value == Sampling::contract;
  Tracing tracing{
      tracer, scene.camera.width, scene.camera.height, settings.transfer, scene.lights.size(),
      pool,   progress,           settings.budget_ms,  is_contract};
  if (is_contract) {
    render_by_contract(settings, most_samples(scene, limits), tracing, rendering);
  } else {
    const int samples = settings.samples.value_or(1);
    std::optional<Image> image = tracing.pass(samples, false);
    rendering.samples_per_pixel = samples;
    rendering.stop = image ? Stop::samples : Stop::cancelled;
    if (image) rendering.image = std::move(*image);
  }
  rendering.trace_ms = tracing.watch.elapsed_ms();
  if (rendering.stop != Stop::cancelled) progress.fraction = 1;
  return rendering;
}

}  // namespace raytracer
