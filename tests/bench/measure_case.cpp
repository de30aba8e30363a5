#include "tests/bench/measure_case.h"

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

/// Each peer once; POV-Ray only if `with_povray`. Replaces the pictures. The forecast is of
/// `scene`, which is the document's.
Round run_round(const Scene& scene, const std::string& document, const Overrides& overrides,
                const Peers& peers, bool with_povray, Pictures& pictures) {
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
  if (with_povray) {
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
  // POV-Ray may parse for half a minute: the others then go on without it.
  constexpr double povray_share_of_time = 0.5;
  const double limit_ms = 1000 * effort.seconds_per_case;

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

  const Stopwatch watch;
  double povray_ms = 0;
  for (int i = 0; i < effort.rounds && (i < fewest_rounds || watch.elapsed_ms() < limit_ms); ++i) {
    const bool with_povray = peers.povray && povray_ms <= povray_share_of_time * limit_ms;
    figures.rounds.push_back(
        run_round(first.scene, document, overrides, peers, with_povray, figures.pictures));
    if (with_povray) povray_ms += figures.rounds.back().povray->process_ms;
  }
  compare_pictures(first.scene.background, figures);
  return figures;
}

}  // namespace raytracer::bench
