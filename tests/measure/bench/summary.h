// A case's rounds reduced to medians.
#pragma once

#include <optional>

#include "tests/measure/bench/measure_case.h"

namespace raytracer::bench {

struct EmbreeSummary {
  EmbreeMode mode{};  ///< the one with the least median of the trace time
  EmbreeTimes times;
  double trace_ms = 0;               ///< by that mode
  double trace_ratio = 0;            ///< Embree's over the project's
  double build_and_trace_ratio = 0;  ///< the project's with the plan
};

struct PovraySummary {
  PovrayTimes times;
  std::size_t round_count = 0;
  double project_trace_ms = 0;  ///< in the same rounds
  double trace_ratio = 0;       ///< POV-Ray's trace time over the project's
  double process_ratio = 0;     ///< its process over read, plan, build, trace and encode
};

struct ForecastSummary {
  ProjectForecast times;
  double build_ratio = 0;  ///< foreseen over measured
  double trace_ratio = 0;
};

/// Ratios are medians of the rounds' ratios, not ratios of medians.
struct Summary {
  ProjectTimes project;
  ForecastSummary forecast;
  std::optional<EmbreeSummary> embree{};
  std::optional<PovraySummary> povray{};
};

Summary summarize(const CaseFigures& figures);

}  // namespace raytracer::bench
