#include "tests/measure/bench/project_peer.h"

#include <optional>
#include <stdexcept>

#include "engine/measure/stopwatch.h"

namespace raytracer::bench {

ProjectRun run_project(std::string_view document, const Overrides& overrides, WorkerPool& pool) {
  ProjectRun run;
  const Stopwatch read_watch;
  Result<Scene> scene = read_scene(document, Limits{}, overrides);
  run.times.read_ms = read_watch.elapsed_ms();
  if (!scene.ok())
    throw std::runtime_error(scene.errors()[0].pointer + ": " + scene.errors()[0].detail);
  run.scene = std::move(scene).value();

  RenderProgress progress;
  ByteRendering rendering = render_bytes(run.scene, Limits{}, pool, progress);
  run.times.plan_ms = rendering.plan_ms;
  run.times.build_ms = rendering.build_ms;
  run.times.trace_ms = rendering.trace_ms;
  run.image = std::move(rendering.image);

  const Stopwatch encode_watch;
  const std::string png = encode(run.image, ImageFormat::png, pool);
  run.times.encode_ms = encode_watch.elapsed_ms();
  return run;
}

ProjectForecast forecast_project(const Scene& scene, const MachineCosts& costs, WorkerPool& pool) {
  const RenderProgress progress;
  const Stopwatch watch;
  const std::optional<Forecast> foreseen = forecast(scene, Limits{}, costs, pool, progress);
  return {foreseen->prediction.build_ms, foreseen->prediction.trace_ms, watch.elapsed_ms()};
}

ByteImage render_without_ambient(Scene scene, WorkerPool& pool) {
  scene.ambient = 0;
  RenderProgress progress;
  return render_bytes(scene, Limits{}, pool, progress).image;
}

}  // namespace raytracer::bench
