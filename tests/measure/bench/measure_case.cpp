#include "tests/measure/bench/measure_case.h"

#include <functional>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "engine/measure/stopwatch.h"

namespace raytracer::bench {
namespace {

using peers::Peer;

/// At least `fewest`, and no new one after `limit_ms`.
void run_rounds(const Effort& effort, int fewest, double limit_ms,
                const std::function<void()>& run_round) {
  const Stopwatch watch;
  for (int i = 0; i < effort.rounds && (i < fewest || watch.elapsed_ms() < limit_ms); ++i)
    run_round();
}

PeerFigures measure_peer(Peer& peer, const Scene& scene,
                         const std::function<ProjectTimes()>& run_project, const Effort& effort,
                         double limit_ms, WorkerPool& pool) {
  PeerFigures figures{.name = peer.name(), .refusal = peer.refusal(scene)};
  if (figures.refusal) return figures;
  figures.differences = peer.differences(scene);
  try {
    peer.set_scene(scene);
    if (!peer.is_program()) peer.draw();
    Image image;
    const int fewest = peer.is_program() ? 1 : 3;  // a program may read for half a minute
    run_rounds(effort, fewest, limit_ms, [&] {
      const ProjectTimes project = run_project();
      peers::Drawing drawing = peer.draw();
      figures.rounds.push_back({project, drawing.times, drawing.way});
      image = std::move(drawing.image);
    });
    figures.picture = rounded(peers::stored(std::move(image), scene.render.transfer));
    figures.project_picture = picture_of(peers::scene_drawn(peer, scene), pool);
    figures.difference = compare_images(figures.project_picture, figures.picture);
  } catch (const std::runtime_error& error) {
    std::cerr << error.what() << std::endl;
    figures = {.name = peer.name(), .refusal = "it fails, as it said while this ran"};
  }
  return figures;
}

}  // namespace

CaseFigures measure_case(const Case& measured, const Effort& effort, const MachineCosts& costs,
                         const peers::Peers& all_peers, WorkerPool& pool) {
  const double limit_ms =
      1000 * effort.seconds_per_case / static_cast<double>(1 + all_peers.size());
  const std::string document = measured.scene.document();
  Overrides view = measured.view;
  if (!view.samples)
    view.samples = measure::read_document(document, view).render.samples.value_or(1);

  const ProjectRun first = run_project(document, view, pool);
  const Scene& scene = first.scene;
  CaseFigures figures{.measured = measured,
                      .width_px = scene.camera.width,
                      .height_px = scene.camera.height,
                      .samples = *view.samples,
                      .document_bytes = document.size(),
                      .covered = covered_share(first.image, scene.background.value_or(Rgb{}),
                                               scene.render.transfer)};
  const auto project_times = [&] { return run_project(document, view, pool).times; };
  run_rounds(effort, 3, limit_ms, [&] {
    figures.rounds.push_back({forecast_project(scene, costs, pool), project_times()});
  });
  for (const auto& peer : all_peers)
    figures.peers.push_back(measure_peer(*peer, scene, project_times, effort, limit_ms, pool));
  return figures;
}

}  // namespace raytracer::bench
