// The report as JSON: every figure of every round.

#include <nlohmann/json.hpp>

#include "tests/measure/bench/report.h"
#include "tests/measure/bench/summary.h"

namespace raytracer::bench {
namespace {

using Json = nlohmann::ordered_json;
using measure::rounded;

Json json_of(const ProjectTimes& times) {
  return {{"read_ms", rounded(times.read_ms)},
          {"plan_ms", rounded(times.plan_ms)},
          {"build_ms", rounded(times.build_ms)},
          {"trace_ms", rounded(times.trace_ms)},
          {"encode_ms", rounded(times.encode_ms)}};
}

Json json_of(const ProjectForecast& forecast) {
  return {{"build_ms", rounded(forecast.build_ms)},
          {"trace_ms", rounded(forecast.trace_ms)},
          {"taken_ms", rounded(forecast.taken_ms)}};
}

Json json_of(const peers::PeerTimes& times) {
  return {{"read_ms", rounded(times.read_ms)},
          {"build_ms", rounded(times.build_ms)},
          {"trace_ms", rounded(times.trace_ms)},
          {"whole_ms", rounded(times.whole_ms)}};
}

Json json_of(const PeerFigures& figures) {
  Json json{{"name", figures.name}};
  if (figures.refusal) {
    json["refusal"] = *figures.refusal;
    return json;
  }
  const PeerSummary summary = summarize(figures);
  json.update(json_of(summary.times));
  json["way"] = summary.way;
  json["trace_ratio"] = summary.trace_ratio;
  json["build_and_trace_ratio"] = summary.build_and_trace_ratio;
  json["whole_ratio"] = summary.whole_ratio;
  json["rmse"] = figures.difference.rmse;
  json["share_off"] = figures.difference.share_off;
  json["known_differences"] = figures.differences;
  for (const PeerRound& round : figures.rounds)
    json["rounds"].push_back(
        {{"project", json_of(round.project)}, {"peer", json_of(round.peer)}, {"way", round.way}});
  return json;
}

Json json_of(const CaseFigures& figures) {
  const Summary summary = summarize(figures);
  Json json{{"scene", figures.measured.scene.name},
            {"width", figures.width_px},
            {"height", figures.height_px},
            {"samples", figures.samples},
            {"document_bytes", figures.document_bytes},
            {"covered", figures.covered},
            {"forecast", json_of(summary.forecast.times)},
            {"project", json_of(summary.project)}};
  json["forecast"]["build_ratio"] = summary.forecast.build_ratio;
  json["forecast"]["trace_ratio"] = summary.forecast.trace_ratio;
  for (const PeerFigures& peer : figures.peers) json["peers"].push_back(json_of(peer));
  for (const AloneRound& round : figures.rounds)
    json["rounds"].push_back(
        {{"forecast", json_of(round.forecast)}, {"project", json_of(round.project)}});
  return json;
}

}  // namespace

std::string to_json(const Report& report) {
  // A line for each case: short files, and differences that can be read.
  std::string text = "{\"run\": " + json_of(report.head).dump() + ",\n\"cases\": [";
  const char* separator = "\n";
  for (const CaseFigures& figures : report.cases) {
    text += separator + json_of(figures).dump();
    separator = ",\n";
  }
  return text + "\n]}\n";
}

}  // namespace raytracer::bench
