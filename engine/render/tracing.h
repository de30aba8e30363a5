// One pass over the image, and what every pass needs.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

#include "engine/errors/error_model.h"
#include "engine/image/subtile_errors.h"
#include "engine/image/tile.h"
#include "engine/measure/stopwatch.h"
#include "engine/plan/plan.h"
#include "engine/plan/tiles.h"
#include "engine/render/built_scene.h"
#include "engine/render/progress.h"

namespace raytracer {

/// A scene made ready, and what every pass over the image needs.
struct Tracing {
  Tracing(const BuiltScene& built, WorkerPool& worker_pool, RenderProgress& render_progress)
      : tracer(built.tracer),
        scene(built.scene),
        plan(built.plan),
        pool(worker_pool),
        progress(render_progress),
        plan_ms(built.plan_ms) {}

  const Tracer& tracer;
  const Scene& scene;
  const Plan& plan;
  WorkerPool& pool;
  RenderProgress& progress;
  double plan_ms;  ///< that it took to pack and to plan
  int passes_done = 0;
  BeyondRange beyond{};  ///< of the passes so far, as RenderReport says
  Stopwatch watch{};

  /// What is left of the budget for samples, in milliseconds; infinite without one.
  double rest_ms() const {
    const std::optional<double>& budget_ms = scene.render.budget_ms;
    return budget_ms ? RefinementModel::budget_share * *budget_ms - watch.elapsed_ms() : infinity;
  }

  /// Whether the budget is spent, or would be `more_ms` from now.
  bool is_over_time(double more_ms = 0) const { return rest_ms() < more_ms; }

  /// An image with these samples in the pixels of `region` (the others are not touched), and what
  /// they tell of its errors if somebody wants it and the pattern has half buffers; nothing if it
  /// was stopped before all were done.
  template <typename Channel>
  std::optional<Raster<Channel>> pass(const SamplePattern& pattern, const TileErrors& errors,
                                      const Tile& region) {
    Raster<Channel> image(scene.camera.width, scene.camera.height, channel_count(scene));
    const auto samples = static_cast<int>(pattern.points.size());
    const std::vector<Tile> tiles = split_into_tiles(region, plan.tile_side_px.value);
    std::vector<BeyondRange> beyond_in_tiles(tiles.size());
    std::atomic<bool> stop{progress.stop.load()};
    std::atomic<std::size_t> done{0};
    std::optional<Preview::Pass> preview;
    if constexpr (std::is_same_v<Channel, float>) preview.emplace(progress.preview, image, tiles);
    const auto report_and_look = [&](double fraction) {
      if (progress.stop) stop = true;
      report(fraction);
    };
    const auto finished = [&](std::size_t i, const BeyondRange& in_tile) {
      beyond_in_tiles[i] = in_tile;
      if (preview) preview->finished(i);
      report_and_look(static_cast<double>(++done) / static_cast<double>(tiles.size()));
    };
    const TileOutput output{scene.render.transfer, &image, errors};
    if (tiles.size() == 1 && is_one_tile(scene, samples))
      finished(0, render_tile(tracer, pattern, tiles[0], output));
    else
      render_tiles(tracer, pattern, tiles, output, {pool, stop, finished, report_and_look});
    preview.reset();  // before the image moves
    if (stop) return {};
    for (const BeyondRange& in_tile : beyond_in_tiles) beyond += in_tile;
    ++passes_done;
    return image;
  }

  /// Under a budget progress is the time's, and slows down before the end: what is begun may take
  /// longer. Under a target alone nobody knows how many passes will follow: each takes half of what
  /// those before have left.
  void report(double pass_fraction) {
    constexpr double near_end = 0.95;
    constexpr double before_end = 1 - std::numeric_limits<double>::epsilon();
    double fraction = pass_fraction;
    if (scene.render.budget_ms) {
      fraction = watch.elapsed_ms() / *scene.render.budget_ms;
      if (fraction > near_end)
        fraction = std::min(1 - (1 - near_end) * near_end / fraction, before_end);
    } else if (scene.render.target_rmse) {
      fraction = std::min(1 - std::ldexp(1 - pass_fraction / 2, -passes_done), before_end);
    }
    double before = progress.fraction;
    while (before < fraction && !progress.fraction.compare_exchange_weak(before, fraction)) {
    }
  }
};

}  // namespace raytracer
