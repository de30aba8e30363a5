#include "tests/measure/tradeoff/equal_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "engine/measure/stopwatch.h"
#include "engine/tradeoff/difference.h"
#include "tests/measure/report/median.h"
#include "tests/measure/tradeoff/exact_picture.h"
#include "tests/measure/tradeoff/peer_sweep.h"
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

/// A peer that can draw the scene, and its sweep.
struct Contestant {
  const peers::Peer* peer;
  PeerSweep sweep;
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
    return measure::median(a.figures.trace_ms) < measure::median(b.figures.trace_ms);
  });
  if (best == candidates.end()) return {};
  return std::move(best->figures);
}

/// Several: those of the sweep were measured once.
std::vector<Candidate> candidates_of(const Contestant& contestant, double target,
                                     Transfer transfer) {
  constexpr std::size_t few = 3;
  std::vector<Candidate> candidates;
  for (const std::size_t i : cheapest_few_within(contestant.sweep.points, target, few)) {
    const SweepPoint& point = contestant.sweep.points[i];
    candidates.push_back(
        {{point.setting, point.rmse}, [&contestant, i, transfer] {
           return draw(*contestant.peer, contestant.sweep.settings[i], transfer).times.trace_ms;
         }});
  }
  return candidates;
}

TargetFigures measure_target(double target, const EqualErrorEffort& effort, const Scene& scene,
                             const Image& exact, const std::vector<Contestant>& contestants,
                             WorkerPool& pool) {
  constexpr int fewest_rounds = 3;
  TargetFigures row{.target = target};
  std::vector<std::vector<Candidate>> candidates;
  candidates.reserve(contestants.size());
  for (const Contestant& contestant : contestants)
    candidates.push_back(candidates_of(contestant, target, scene.render.transfer));
  Overrides overrides;
  overrides.target_rmse = target;
  const Stopwatch watch;
  for (int i = 0;
       i < effort.rounds && (i < fewest_rounds || watch.elapsed_ms() < 1000 * effort.seconds);
       ++i) {
    Rendering rendering;
    row.trace_ms.push_back(settled_ms([&] {
      rendering = render_with(scene, overrides, pool);
      return rendering.trace_ms;
    }));
    row.rmse = difference(rendering.image, exact).rmse;
    row.estimated_error = rendering.estimated_error;
    row.samples_per_pixel = rendering.samples_per_pixel;
    for (std::vector<Candidate>& of_peer : candidates) run_round(of_peer, effort.seconds);
  }
  for (std::vector<Candidate>& of_peer : candidates) row.peers.push_back(best_of(of_peer));
  return row;
}

/// Of as many pixels as 175 x 125, which 700 x 500 becomes.
Scene made_small(const std::string& document) {
  constexpr double pixel_count = 175 * 125;
  const Scene scene = measure::read_document(document, {});
  const double width = scene.camera.width;
  const double height = scene.camera.height;
  const double scale = std::sqrt(pixel_count / (width * height));
  Overrides overrides;
  overrides.width = std::max(1, static_cast<int>(std::lround(width * scale)));
  overrides.height = std::max(1, static_cast<int>(std::lround(height * scale)));
  overrides.samples = 1;  // no contract; each who draws has its own
  return with_overrides(scene, overrides);
}

}  // namespace

EqualErrorFigures measure_equal_error(const measure::NamedScene& measured,
                                      const EqualErrorEffort& effort, const peers::Peers& all_peers,
                                      WorkerPool& pool) {
  const double least_target = effort.targets.back();
  const Scene scene = made_small(measured.document());
  const ExactPicture exact = render_exactly(scene, effort.exact_samples, pool);
  EqualErrorFigures figures{.scene = measured.name,
                            .width_px = scene.camera.width,
                            .height_px = scene.camera.height,
                            .exact_samples = exact.samples,
                            .exact_error = exact.estimated_error};
  figures.with_samples = sweep_samples(scene, exact.image, least_target, pool);
  figures.with_target = sweep_targets(scene, exact.image, least_target, pool);

  std::optional<Image> without_ambient;
  std::vector<Contestant> contestants;
  for (const auto& peer : all_peers) {
    contestants.push_back({peer.get(), {}});
    PeerOutcome outcome{.name = peer->name(), .refusal = peer->refusal(scene)};
    const bool omits_ambient = peer->omits_ambient(scene);
    if (!outcome.refusal && omits_ambient && !without_ambient)
      without_ambient =
          render_exactly(peers::scene_drawn(*peer, scene), effort.exact_samples, pool).image;
    if (!outcome.refusal) try {
        peer->set_scene(scene);
        contestants.back().sweep = sweep_peer(*peer, omits_ambient ? *without_ambient : exact.image,
                                              scene.render.transfer, least_target);
        outcome.differences = peer->differences(scene);
        outcome.sweep = contestants.back().sweep.points;
      } catch (const std::runtime_error& error) {
        std::cerr << error.what() << std::endl;
        outcome.refusal = "it fails, as it said while this ran";
      }
    figures.peers.push_back(std::move(outcome));
  }
  for (const double target : effort.targets)
    figures.targets.push_back(
        measure_target(target, effort, scene, exact.image, contestants, pool));
  return figures;
}

double median_ratio(const TargetFigures& figures, const PeerFigures& peer) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < peer.trace_ms.size(); ++i)
    ratios.push_back(peer.trace_ms[i] / figures.trace_ms[i]);
  return measure::median(std::move(ratios));
}

}  // namespace raytracer::published
