#include "tests/tradeoff/equal_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "engine/measure/stopwatch.h"
#include "engine/tradeoff/difference.h"
#include "tests/bench/median.h"
#include "tests/tradeoff/exact_picture.h"
#include "tests/tradeoff/peer_sweeps.h"

namespace raytracer::published {
namespace {

/// The median of several renders of one setting, after one to warm up.
SweepPoint measure_project(const std::string& name, const Scene& scene, const Overrides& overrides,
                           const Image& exact, WorkerPool& pool) {
  constexpr int repetitions = 5;
  std::vector<double> times_ms;
  Rendering rendering = render_with(scene, overrides, pool);
  for (int i = 0; i < repetitions; ++i) {
    rendering = render_with(scene, overrides, pool);
    times_ms.push_back(rendering.trace_ms);
  }
  return {name, bench::median(times_ms), difference(rendering.image, exact).rmse};
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

/// Embree's side of a round: every mode once.
class EmbreeRounds {
 public:
  EmbreeRounds(bench::EmbreePeer& embree, bench::EmbreeWorld& world, int side, Image& image)
      : embree_(embree), world_(world), side_(side), image_(image) {}

  void run() {
    bench::set_sample_grid(world_, side_);
    for (std::size_t i = 0; i < times_ms_.size(); ++i)
      times_ms_[i].push_back(embree_.trace(world_, bench::embree_modes[i], image_));
  }

  /// The times of the mode with the least median.
  PeerFigures best(const std::string& setting, double rmse) const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < times_ms_.size(); ++i)
      if (bench::median(times_ms_[i]) < bench::median(times_ms_[best])) best = i;
    return {setting + ", " + name_of(bench::embree_modes[best]), rmse, times_ms_[best]};
  }

 private:
  bench::EmbreePeer& embree_;
  bench::EmbreeWorld& world_;
  int side_;
  Image& image_;
  std::array<std::vector<double>, bench::embree_modes.size()> times_ms_{};
};

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

TargetFigures measure_target(double target, const EqualErrorEffort& effort,
                             const Contest& contest) {
  constexpr int fewest_rounds = 3;
  TargetFigures row{.target = target};
  const auto grid = cheapest_within(contest.embree_sweep.points, target);
  const auto setting = cheapest_within(contest.povray_sweep.points, target);
  Image image(contest.exact.width, contest.exact.height);
  EmbreeRounds embree_rounds(contest.embree, contest.world, grid ? static_cast<int>(*grid) + 1 : 1,
                             image);
  std::vector<double> povray_ms;
  Overrides overrides;
  overrides.target_rmse = target;
  render_with(contest.scene, overrides, contest.pool);  // the warm-up; the peers had theirs

  const Stopwatch watch;
  for (int i = 0;
       i < effort.rounds && (i < fewest_rounds || watch.elapsed_ms() < 1000 * effort.seconds);
       ++i) {
    const Rendering rendering = render_with(contest.scene, overrides, contest.pool);
    row.trace_ms.push_back(rendering.trace_ms);
    row.rmse = difference(rendering.image, contest.exact).rmse;
    row.estimated_error = rendering.estimated_error;
    row.samples_per_pixel = rendering.samples_per_pixel;
    if (grid) embree_rounds.run();
    if (setting)
      povray_ms.push_back(
          contest.povray.run(contest.povray_sweep.settings[*setting]).times.trace_ms);
  }
  if (grid) {
    const SweepPoint& point = contest.embree_sweep.points[*grid];
    row.embree = embree_rounds.best(point.setting, point.rmse);
  }
  if (setting) {
    const SweepPoint& point = contest.povray_sweep.points[*setting];
    row.povray = PeerFigures{point.setting, point.rmse, std::move(povray_ms)};
  }
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
  figures.povray_floor = povray_sweep.floor_rmse;
  return figures;
}

double median_ratio(const TargetFigures& figures, const PeerFigures& peer) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < peer.trace_ms.size(); ++i)
    ratios.push_back(peer.trace_ms[i] / figures.trace_ms[i]);
  return bench::median(std::move(ratios));
}

}  // namespace raytracer::published
