#include "tests/measure/bench/summary.h"

#include <utility>

#include "tests/measure/report/median.h"

namespace raytracer::bench {
namespace {

/// The median over `rounds` of value(round).
template <typename Value>
double median_of(const std::vector<Round>& rounds, Value value) {
  std::vector<double> values;
  values.reserve(rounds.size());
  for (const Round& round : rounds) values.push_back(value(round));
  return median(std::move(values));
}

double build_and_trace_ms(const ProjectTimes& times) {
  return times.plan_ms + times.build_ms + times.trace_ms;
}

ProjectTimes summarize_project(const std::vector<Round>& rounds) {
  const auto stage = [&](double ProjectTimes::*time) {
    return median_of(rounds, [&](const Round& round) { return round.project.*time; });
  };
  return {.read_ms = stage(&ProjectTimes::read_ms),
          .plan_ms = stage(&ProjectTimes::plan_ms),
          .build_ms = stage(&ProjectTimes::build_ms),
          .trace_ms = stage(&ProjectTimes::trace_ms),
          .encode_ms = stage(&ProjectTimes::encode_ms)};
}

ForecastSummary summarize_forecast(const std::vector<Round>& rounds) {
  const auto figure = [&](double ProjectForecast::*time) {
    return median_of(rounds, [&](const Round& round) { return round.forecast.*time; });
  };
  return {.times = {.build_ms = figure(&ProjectForecast::build_ms),
                    .trace_ms = figure(&ProjectForecast::trace_ms),
                    .taken_ms = figure(&ProjectForecast::taken_ms)},
          .build_ratio = median_of(
              rounds,
              [](const Round& round) { return round.forecast.build_ms / round.project.build_ms; }),
          .trace_ratio = median_of(rounds, [](const Round& round) {
            return round.forecast.trace_ms / round.project.trace_ms;
          })};
}

EmbreeSummary summarize_embree(const std::vector<Round>& rounds) {
  EmbreeSummary summary;
  std::size_t best = 0;
  for (std::size_t i = 0; i < embree_modes.size(); ++i) {
    summary.times.trace_ms[i] =
        median_of(rounds, [&](const Round& round) { return round.embree->trace_ms[i]; });
    if (summary.times.trace_ms[i] < summary.times.trace_ms[best]) best = i;
  }
  summary.mode = embree_modes[best];
  summary.trace_ms = summary.times.trace_ms[best];
  summary.times.build_ms =
      median_of(rounds, [](const Round& round) { return round.embree->build_ms; });
  summary.trace_ratio = median_of(rounds, [&](const Round& round) {
    return round.embree->trace_ms[best] / round.project.trace_ms;
  });
  summary.build_and_trace_ratio = median_of(rounds, [&](const Round& round) {
    return (round.embree->build_ms + round.embree->trace_ms[best]) /
           build_and_trace_ms(round.project);
  });
  return summary;
}

PovraySummary summarize_povray(const std::vector<Round>& rounds) {
  const auto stage = [&](double PovrayTimes::*time) {
    return median_of(rounds, [&](const Round& round) { return (*round.povray).*time; });
  };
  return {.times = {.parse_ms = stage(&PovrayTimes::parse_ms),
                    .bounding_ms = stage(&PovrayTimes::bounding_ms),
                    .trace_ms = stage(&PovrayTimes::trace_ms),
                    .process_ms = stage(&PovrayTimes::process_ms)},
          .round_count = rounds.size(),
          .project_trace_ms = summarize_project(rounds).trace_ms,
          .trace_ratio = median_of(
              rounds,
              [](const Round& round) { return round.povray->trace_ms / round.project.trace_ms; }),
          .process_ratio = median_of(rounds, [](const Round& round) {
            return round.povray->process_ms /
                   (round.project.read_ms + build_and_trace_ms(round.project) +
                    round.project.encode_ms);
          })};
}

}  // namespace

Summary summarize(const CaseFigures& figures) {
  Summary summary{.project = summarize_project(figures.rounds),
                  .forecast = summarize_forecast(figures.rounds)};
  if (figures.rounds[0].embree) summary.embree = summarize_embree(figures.rounds);
  if (!figures.povray_rounds.empty()) summary.povray = summarize_povray(figures.povray_rounds);
  return summary;
}

}  // namespace raytracer::bench
