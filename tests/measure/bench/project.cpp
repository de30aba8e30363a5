#include "tests/measure/bench/project.h"

#include <optional>

#include "engine/measure/stopwatch.h"
#include "tests/measure/scenes/named_scene.h"

namespace raytracer::bench {

ProjectRun run_project(std::string_view document, const Overrides& overrides, WorkerPool& pool) {
  ProjectRun run;
  const Stopwatch read_watch;
  run.scene = measure::read_document(document, overrides);
  run.times.read_ms = read_watch.elapsed_ms();

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
  const std::optional<Forecast> predicted = forecast(scene, Limits{}, costs, pool, progress);
  return {predicted->prediction.build_ms, predicted->prediction.trace_ms, watch.elapsed_ms()};
}

ByteImage picture_of(const Scene& scene, WorkerPool& pool) {
  RenderProgress progress;
  return render_bytes(scene, Limits{}, pool, progress).image;
}

}  // namespace raytracer::bench
