#include "engine/forecast/swept_tiles.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>

#include "engine/measure/stopwatch.h"
#include "engine/render/swept_light.h"
#include "engine/sample/pattern.h"

namespace raytracer {
namespace {

/// Calls visit(scene, target) with what a tracer of packets has, if it sweeps.
template <typename Visit>
void visit_swept(const Tracer& tracer, const Visit& visit) {
  std::visit(
      [&](const auto& chosen) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(chosen)>, ReferenceTracer>)
          if (chosen.scene.sweeps_soft_light) visit(chosen.scene, chosen.target);
      },
      tracer);
}

/// Of the directions that are swept.
template <typename T>
double share_of_sets(const PacketScene<T>& scene) {
  double in_sets = 0;
  double all = 0;
  for (const PacketSoftLight<T>& soft : scene.soft_lights) {
    if (soft.directions.empty()) continue;
    in_sets += static_cast<double>(soft.numbers.sets * soft.numbers.per_set);
    all += static_cast<double>(soft.numbers.count());
  }
  return in_sets / all;
}

}  // namespace

double SweepCost::ms(double samples) const {
  const double used_sets = std::min(4 * samples, static_cast<double>(sets)) / sets;
  const double used = share_of_sets * used_sets + 1 - share_of_sets;
  return all_ms * used * std::ceil(pixels * samples / pixels_at_once);
}

bool is_swept(const Tracer& tracer) {
  bool is = false;
  visit_swept(tracer, [&](const auto&, std::int64_t) { is = true; });
  return is;
}

SweptTiles trace_swept(const Tracer& tracer, const SamplePattern& pattern,
                       std::span<const Tile> tiles, const TileOutput& output, WorkerPool& pool,
                       const std::atomic<bool>& stop) {
  SweptTiles swept{std::vector<double>(tiles.size(), 0), 0};
  visit_swept(tracer, [&]<typename T>(const PacketScene<T>& scene, std::int64_t target) {
    SweptLight<T> light(scene, target, tiles.size());
    pool.run(
        tiles.size(),
        [&](std::size_t i) {
          const ThreadStopwatch watch;
          light.record(i, pattern, tiles[i]);
          swept.tile_ms[i] = watch.elapsed_ms();
        },
        stop);
    if (stop) return;
    SweepMemory<T> memory;
    std::vector<double> ms(light.begin_sweeps(), 0);
    pool.run(
        ms.size(),
        [&](std::size_t i) {
          const ThreadStopwatch watch;
          light.sweep_one(i, memory);
          ms[i] = watch.elapsed_ms();
        },
        stop);
    if (stop) return;
    swept.sweeps_ms = std::accumulate(ms.begin(), ms.end(), 0.0);
    light.end_sweeps();
    pool.run(
        tiles.size(),
        [&](std::size_t i) {
          const ThreadStopwatch watch;
          light.render_tile(i, pattern, tiles[i], output);
          swept.tile_ms[i] += watch.elapsed_ms();
        },
        stop);
  });
  return swept;
}

SweepCost measure_sweeps(const Tracer& tracer, std::span<const Tile> tiles) {
  constexpr std::size_t measured = 4;
  SweepCost cost;
  visit_swept(tracer, [&]<typename T>(const PacketScene<T>& scene, std::int64_t target) {
    cost.sets = scene.light_sets;
    cost.share_of_sets = share_of_sets(scene);
    cost.pixels = scene.view.pixel_count();
    cost.pixels_at_once = static_cast<double>(samples_at_once(scene.primitives.size()));
    const SamplePattern pattern = sample_pattern(1);
    for (const Tile& tile : tiles) {
      SweptLight<T> light(scene, target, 1);
      light.record(0, pattern, tile);
      const std::size_t directions = light.begin_sweeps();
      if (directions == 0) continue;
      SweepMemory<T> memory;
      light.sweep_one(0, memory);
      const ThreadStopwatch watch;
      for (std::size_t i = 0; i < measured; ++i) light.sweep_one(i % directions, memory);
      cost.all_ms = watch.elapsed_ms() / measured * static_cast<double>(directions);
      return;
    }
  });
  return cost;
}

}  // namespace raytracer
