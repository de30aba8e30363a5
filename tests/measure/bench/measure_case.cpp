#include "tests/measure/bench/measure_case.h"

#include <utility>

#include "engine/measure/stopwatch.h"

namespace raytracer::bench {
namespace {

Overrides overrides_of(const Case& measured) {
  Overrides overrides;
  overrides.width = measured.width;
  overrides.height = measured.height;
  overrides.samples = measured.samples;
  return overrides;
}

/// The project and each of `peers` once. Replaces the pictures. The forecast is of `scene`, which
/// is the document's.
Round run_round(const Scene& scene, const std::string& document, const Overrides& overrides,
                const Peers& peers, Pictures& pictures) {
  Round round;
  round.forecast = forecast_project(scene, peers.costs, peers.pool);
  ProjectRun project = run_project(document, overrides, peers.pool);
  round.project = project.times;
  pictures.project = std::move(project.image);
  if (peers.embree) {
    EmbreeRun embree = peers.embree->run(project.scene);
    round.embree = embree.times;
    pictures.embree = std::move(embree.image);
  }
  if (peers.povray) {
    PovrayRun povray = peers.povray->run();
    round.povray = povray.times;
    pictures.povray = std::move(povray.image);
  }
  return round;
}

void compare_pictures(const Rgb& background, CaseFigures& figures) {
  const Pictures& pictures = figures.pictures;
  figures.covered = covered_share(pictures.project, background);
  if (!pictures.embree.values.empty())
    figures.embree_off = compare_images(pictures.project, pictures.embree);
  if (!pictures.povray.values.empty())
    figures.povray_off = compare_images(pictures.project_without_ambient, pictures.povray);
}

}  // namespace

CaseFigures measure(const Case& measured, const Effort& effort, const Peers& peers) {
  constexpr int fewest_rounds = 3;
  constexpr int fewest_povray_rounds = 1;  // it may parse for half a minute
  const double limit_ms = 1000 * effort.seconds_per_case / (peers.povray ? 2 : 1);

  CaseFigures figures{.measured = measured};
  const std::string document = measured.document();
  const Overrides overrides = overrides_of(measured);
  figures.document_bytes = document.size();

  // The warm-up, and what is not timed.
  const ProjectRun first = run_project(document, overrides, peers.pool);
  if (peers.embree) peers.embree->run(first.scene);
  if (peers.povray) {
    peers.povray->set_scene(first.scene);
    figures.pictures.project_without_ambient = render_without_ambient(first.scene, peers.pool);
  }

  const auto run_rounds = [&](int fewest, const Peers& taking_part, std::vector<Round>& rounds) {
    const Stopwatch watch;
    for (int i = 0; i < effort.rounds && (i < fewest || watch.elapsed_ms() < limit_ms); ++i)
      rounds.push_back(run_round(first.scene, document, overrides, taking_part, figures.pictures));
  };
  run_rounds(fewest_rounds, {peers.pool, peers.costs, peers.embree, nullptr}, figures.rounds);
  if (peers.povray)
    run_rounds(fewest_povray_rounds, {peers.pool, peers.costs, nullptr, peers.povray},
               figures.povray_rounds);
  compare_pictures(first.scene.background, figures);
  return figures;
}

}  // namespace raytracer::bench
