#include "tests/measure/bench/summary.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "tests/measure/report/median.h"

namespace raytracer::bench {
namespace {

/// The median over `rounds` of value(round).
template <typename Round, typename Value>
double median_of(const std::vector<Round>& rounds, const Value& value) {
  std::vector<double> values;
  values.reserve(rounds.size());
  for (const Round& round : rounds) values.push_back(value(round));
  return measure::median(std::move(values));
}

double build_and_trace_ms(const ProjectTimes& times) {
  return times.plan_ms + times.build_ms + times.trace_ms;
}

std::string most_frequent_way(const std::vector<PeerRound>& rounds) {
  std::map<std::string, int> counts;
  for (const PeerRound& round : rounds) ++counts[round.way];
  return std::max_element(counts.begin(), counts.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

}  // namespace

double whole_ms(const ProjectTimes& times) {
  return times.read_ms + build_and_trace_ms(times) + times.encode_ms;
}

Summary summarize(const CaseFigures& figures) {
  const auto stage = [&](double ProjectTimes::*time) {
    return median_of(figures.rounds, [&](const AloneRound& each) { return each.project.*time; });
  };
  const auto predicted = [&](double ProjectForecast::*time) {
    return median_of(figures.rounds, [&](const AloneRound& each) { return each.forecast.*time; });
  };
  const auto ratio = [&](double ProjectForecast::*time, double ProjectTimes::*measured) {
    return median_of(figures.rounds, [&](const AloneRound& each) {
      return each.forecast.*time / each.project.*measured;
    });
  };
  return {.project = {.read_ms = stage(&ProjectTimes::read_ms),
                      .plan_ms = stage(&ProjectTimes::plan_ms),
                      .build_ms = stage(&ProjectTimes::build_ms),
                      .trace_ms = stage(&ProjectTimes::trace_ms),
                      .encode_ms = stage(&ProjectTimes::encode_ms)},
          .forecast = {.times = {.build_ms = predicted(&ProjectForecast::build_ms),
                                 .trace_ms = predicted(&ProjectForecast::trace_ms),
                                 .taken_ms = predicted(&ProjectForecast::taken_ms)},
                       .build_ratio = ratio(&ProjectForecast::build_ms, &ProjectTimes::build_ms),
                       .trace_ratio = ratio(&ProjectForecast::trace_ms, &ProjectTimes::trace_ms)}};
}

PeerSummary summarize(const PeerFigures& figures) {
  const auto of = [&](const auto& value) { return median_of(figures.rounds, value); };
  const auto stage = [&](double peers::PeerTimes::*time) {
    return of([&](const PeerRound& each) { return each.peer.*time; });
  };
  return {.times = {.read_ms = stage(&peers::PeerTimes::read_ms),
                    .build_ms = stage(&peers::PeerTimes::build_ms),
                    .trace_ms = stage(&peers::PeerTimes::trace_ms),
                    .whole_ms = stage(&peers::PeerTimes::whole_ms)},
          .project_trace_ms = of([](const PeerRound& each) { return each.project.trace_ms; }),
          .trace_ratio =
              of([](const PeerRound& each) { return each.peer.trace_ms / each.project.trace_ms; }),
          .build_and_trace_ratio = of([](const PeerRound& each) {
            return (each.peer.build_ms + each.peer.trace_ms) / build_and_trace_ms(each.project);
          }),
          .whole_ratio =
              of([](const PeerRound& each) { return each.peer.whole_ms / whole_ms(each.project); }),
          .way = most_frequent_way(figures.rounds)};
}

double worst_ratio(const CaseFigures& figures) {
  double worst = std::numeric_limits<double>::infinity();
  for (const PeerFigures& peer : figures.peers) {
    if (peer.refusal) continue;
    const PeerSummary summary = summarize(peer);
    worst = std::min({worst, summary.trace_ratio, summary.build_and_trace_ratio});
  }
  return worst;
}

}  // namespace raytracer::bench
