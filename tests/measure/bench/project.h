// The project itself: text to PNG through the engine's public header, each stage timed.
#pragma once

#include <string_view>

#include "engine/engine.h"

namespace raytracer::bench {

struct ProjectTimes {
  double read_ms = 0;
  double plan_ms = 0;
  double build_ms = 0;
  double trace_ms = 0;
  double encode_ms = 0;
};

/// What the project says before it renders.
struct ProjectForecast {
  double build_ms = 0;
  double trace_ms = 0;
  double taken_ms = 0;  ///< by saying it, the structures included
};

struct ProjectRun {
  ProjectTimes times;
  Scene scene;
  ByteImage image;
};

/// Throws std::runtime_error with the first error if the document is refused.
ProjectRun run_project(std::string_view document, const Overrides& overrides, WorkerPool& pool);

ProjectForecast forecast_project(const Scene& scene, const MachineCosts& costs, WorkerPool& pool);

/// Of any scene; not timed.
ByteImage picture_of(const Scene& scene, WorkerPool& pool);

}  // namespace raytracer::bench
