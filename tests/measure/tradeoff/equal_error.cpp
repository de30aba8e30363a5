#include "tests/measure/tradeoff/equal_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "engine/measure/stopwatch.h"
#include "engine/tradeoff/difference.h"
#include "tests/measure/report/median.h"
#include "tests/measure/tradeoff/exact_picture.h"
#include "tests/measure/tradeoff/peer_sweeps.h"
#include "tests/measure/tradeoff/settled_time.h"

namespace raytracer::published {
namespace {

SweepPoint measure_project(const std::string& name, const Scene& scene, const Overrides& overrides,
                           const Image& exact, WorkerPool& pool) {
  Rendering rendering;
  const double trace_ms = settled_ms([&] {
    rendering = render_with(scene, overrides, pool);
    return rendering.trace_ms;
  });
  return {name, trace_ms, difference(rendering.image, exact).rmse};
}

Sweep sweep_samples(const Scene& scene, const Image& exact, double least_target, WorkerPool& pool) {
  Sweep sweep;
  for (int samples = 1; samples <= 1024; samples *= 2) {
    Overrides overrides;
    overrides.samples = samples;
    sweep.push_back(measure_project(std::to_string(samples), scene, overrides, exact, pool));
    if (sweep.back().rmse <= least_target) break;
  }
  return sweep;
}

Sweep sweep_targets(const Scene& scene, const Image& exact, double least_target, WorkerPool& pool) {
  Sweep sweep;
  for (const double target : {0.03, 0.01, 0.005, 0.003, 0.002, 0.001, 0.0005}) {
    if (target < least_target) break;
    Overrides overrides;
    overrides.target_rmse = target;
    sweep.push_back(measure_project(fmt::format("{}", target), scene, overrides, exact, pool));
  }
  return sweep;
}

/// All that runs in turn, and what it is compared with.
struct Contest {
  const Scene& scene;
  const Image& exact;
  WorkerPool& pool;
  bench::EmbreePeer& embree;
  bench::EmbreeWorld& world;
  const EmbreeSweep& embree_sweep;
  const bench::PovrayPeer& povray;
  const PovraySweep& povray_sweep;
};

/// A peer's setting that may be its fastest for a target, which is known only at the end.
struct Candidate {
  PeerFigures figures;
  std::function<double()> trace_ms;
};

/// Each once, but none that has taken so long in all. Those that are clearly slower drop out.
void run_round(std::vector<Candidate>& candidates, double most_seconds) {
  constexpr double near = 1.2;  // times the fastest of the first round
  const auto first_ms = [](const Candidate& candidate) { return candidate.figures.trace_ms[0]; };
  for (Candidate& candidate : candidates) {
    std::vector<double>& times_ms = candidate.figures.trace_ms;
    if (std::accumulate(times_ms.begin(), times_ms.end(), 0.0) < 1000 * most_seconds)
      times_ms.push_back(candidate.trace_ms());
  }
  double fastest_ms = std::numeric_limits<double>::infinity();
  for (const Candidate& candidate : candidates)
    fastest_ms = std::min(fastest_ms, first_ms(candidate));
  std::erase_if(candidates,
                [&](const Candidate& each) { return first_ms(each) > near * fastest_ms; });
}

std::optional<PeerFigures> best_of(std::vector<Candidate>& candidates) {
  const auto best = std::min_element(candidates.begin(), candidates.end(), [](auto& a, auto& b) {
    return bench::median(a.figures.trace_ms) < bench::median(b.figures.trace_ms);
  });
  if (best == candidates.end()) return {};
  return std::move(best->figures);
}

/// The cheapest grid, every way to hand its rays over.
std::vector<Candidate> embree_candidates(double target, const Contest& contest, Image& image) {
  std::vector<Candidate> candidates;
  const auto grid = cheapest_within(contest.embree_sweep.points, target);
  if (!grid) return candidates;
  const SweepPoint& point = contest.embree_sweep.points[*grid];
  for (const bench::EmbreeMode mode : bench::embree_modes)
    candidates.push_back({{point.setting + ", " + name_of(mode), point.rmse},
                          [&contest, &image, mode, side = static_cast<int>(*grid) + 1] {
                            bench::set_sample_grid(contest.world, side);
                            return settled_ms(
                                [&] { return contest.embree.trace(contest.world, mode, image); });
                          }});
  return candidates;
}

/// Several: its times are of whole milliseconds, and the sweep's are measured once.
std::vector<Candidate> povray_candidates(double target, const Contest& contest) {
  constexpr std::size_t few = 3;
  std::vector<Candidate> candidates;
  for (const std::size_t i : cheapest_few_within(contest.povray_sweep.points, target, few)) {
    const SweepPoint& point = contest.povray_sweep.points[i];
    candidates.push_back(
        {{point.setting, point.rmse}, [&contest, setting = contest.povray_sweep.settings[i]] {
           return contest.povray.run(setting).times.trace_ms;
         }});
  }
  return candidates;
}

TargetFigures measure_target(double target, const EqualErrorEffort& effort,
                             const Contest& contest) {
  constexpr int fewest_rounds = 3;
  TargetFigures row{.target = target};
  Image image(contest.exact.width, contest.exact.height);
  std::vector<Candidate> embree = embree_candidates(target, contest, image);
  std::vector<Candidate> povray = povray_candidates(target, contest);
  Overrides overrides;
  overrides.target_rmse = target;
  const Stopwatch watch;
  for (int i = 0;
       i < effort.rounds && (i < fewest_rounds || watch.elapsed_ms() < 1000 * effort.seconds);
       ++i) {
    Rendering rendering;
    row.trace_ms.push_back(settled_ms([&] {
      rendering = render_with(contest.scene, overrides, contest.pool);
      return rendering.trace_ms;
    }));
    row.rmse = difference(rendering.image, contest.exact).rmse;
    row.estimated_error = rendering.estimated_error;
    row.samples_per_pixel = rendering.samples_per_pixel;
    run_round(embree, effort.seconds);
    run_round(povray, effort.seconds);
  }
  row.embree = best_of(embree);
  row.povray = best_of(povray);
  return row;
}

}  // namespace

EqualErrorFigures measure_equal_error(const EqualErrorCase& measured, ImageSize size,
                                      const EqualErrorEffort& effort, WorkerPool& pool,
                                      bench::EmbreePeer& embree, bench::PovrayPeer& povray) {
  const double least_target = effort.targets.back();
  const Scene scene = scene_of(measured.document, size.width_px, size.height_px);
  const ExactPicture exact = render_exactly(scene, effort.exact_samples, pool);
  EqualErrorFigures figures{.scene = measured.scene,
                            .exact_samples = exact.samples,
                            .exact_error = exact.estimated_error};
  figures.with_samples = sweep_samples(scene, exact.image, least_target, pool);
  figures.with_target = sweep_targets(scene, exact.image, least_target, pool);

  double build_ms = 0;
  const auto world = embree.build(scene, build_ms);
  EmbreeSweep embree_sweep = sweep_embree(embree, *world, exact.image, least_target);

  Scene without_ambient = scene;
  without_ambient.ambient = 0;
  povray.set_scene(scene);
  PovraySweep povray_sweep = sweep_povray(
      povray, render_exactly(without_ambient, effort.exact_samples, pool).image, least_target);

  const Contest contest{scene,  exact.image,  pool,   embree,
                        *world, embree_sweep, povray, povray_sweep};
  for (const double target : effort.targets)
    figures.targets.push_back(measure_target(target, effort, contest));
  figures.embree = std::move(embree_sweep.points);
  figures.embree_floor = embree_sweep.floor_rmse;
  figures.povray = std::move(povray_sweep.points);
  return figures;
}

double median_ratio(const TargetFigures& figures, const PeerFigures& peer) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < peer.trace_ms.size(); ++i)
    ratios.push_back(peer.trace_ms[i] / figures.trace_ms[i]);
  return bench::median(std::move(ratios));
}

}  // namespace raytracer::published
