// A case's rounds reduced to medians.
#pragma once

#include <string>
#include <vector>

#include "tests/measure/bench/measure_case.h"

namespace raytracer::bench {

struct ForecastSummary {
  ProjectForecast times;
  double build_ratio = 0;  ///< predicted over measured
  double trace_ratio = 0;
};

/// Of a peer that drew the scene. Its times over the project's.
struct PeerSummary {
  peers::PeerTimes times;
  double project_trace_ms = 0;  ///< in the same rounds
  double trace_ratio = 0;
  double build_and_trace_ratio = 0;  ///< the project's with the plan
  double whole_ratio = 0;            ///< over text to PNG; 0 for what is no program
  std::string way;                   ///< the most frequent
};

/// Ratios are medians of the rounds' ratios, not ratios of medians.
struct Summary {
  ProjectTimes project;
  ForecastSummary forecast;
};

double whole_ms(const ProjectTimes& times);

Summary summarize(const CaseFigures& figures);

PeerSummary summarize(const PeerFigures& figures);

/// The least that any peer takes, traced alone or with its build, over the project's time; infinite
/// where none draws it.
double worst_ratio(const CaseFigures& figures);

}  // namespace raytracer::bench
