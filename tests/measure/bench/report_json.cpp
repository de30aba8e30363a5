// The report as JSON: every figure of every round.

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/measure/bench/report.h"
#include "tests/measure/bench/summary.h"
#include "tests/measure/report/machine_json.h"

namespace raytracer::bench {
namespace {

using Json = nlohmann::ordered_json;

/// To a tenth of a microsecond: the clock knows no more, and the file stays short.
double rounded(double ms) { return std::round(ms * 1e4) / 1e4; }

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

Json json_of(const EmbreeTimes& times) {
  Json json{{"build_ms", rounded(times.build_ms)}};
  for (std::size_t i = 0; i < embree_modes.size(); ++i)
    json["trace_ms"][name_of(embree_modes[i])] = rounded(times.trace_ms[i]);
  return json;
}

Json json_of(const PovrayTimes& times) {
  return {{"parse_ms", rounded(times.parse_ms)},
          {"bounding_ms", rounded(times.bounding_ms)},
          {"trace_ms", rounded(times.trace_ms)},
          {"process_ms", rounded(times.process_ms)}};
}

Json json_of(const ImageDifference& difference) {
  return {{"share_off", difference.share_off}, {"mean_levels", difference.mean_levels}};
}

Json json_of(const CaseFigures& figures) {
  const Summary summary = summarize(figures);
  Json json{{"scene", figures.measured.scene},
            {"width", figures.measured.width},
            {"height", figures.measured.height},
            {"samples", figures.measured.samples},
            {"document_bytes", figures.document_bytes},
            {"covered", figures.covered},
            {"forecast", json_of(summary.forecast.times)},
            {"project", json_of(summary.project)}};
  json["forecast"]["build_ratio"] = summary.forecast.build_ratio;
  json["forecast"]["trace_ratio"] = summary.forecast.trace_ratio;
  if (summary.embree) {
    Json& embree = json["embree"] = json_of(summary.embree->times);
    embree["best"] = name_of(summary.embree->mode);
    embree["trace_ratio"] = summary.embree->trace_ratio;
    embree["build_and_trace_ratio"] = summary.embree->build_and_trace_ratio;
    embree["difference"] = json_of(*figures.embree_off);
  }
  if (summary.povray) {
    Json& povray = json["povray"] = json_of(summary.povray->times);
    povray["trace_ratio"] = summary.povray->trace_ratio;
    povray["process_ratio"] = summary.povray->process_ratio;
    povray["difference"] = json_of(*figures.povray_off);
  }
  const auto add_rounds = [&](const char* name, const std::vector<Round>& rounds) {
    for (const Round& round : rounds) {
      Json entry{{"forecast", json_of(round.forecast)}, {"project", json_of(round.project)}};
      if (round.embree) entry["embree"] = json_of(*round.embree);
      if (round.povray) entry["povray"] = json_of(*round.povray);
      json[name].push_back(std::move(entry));
    }
  };
  add_rounds("rounds", figures.rounds);
  add_rounds("povray_rounds", figures.povray_rounds);
  return json;
}

}  // namespace

std::string to_json(const Report& report) {
  Json head{{"date", report.date},
            {"commit", report.commit},
            {"command", report.command},
            {"threads", report.thread_count},
            {"machine", json_of(report.machine)},
            {"engine", build_id}};
  if (report.embree) head["embree"] = *report.embree;
  if (report.povray) head["povray"] = *report.povray;

  // A line for each case: short files, and differences that can be read.
  std::string text = "{\n";
  for (const auto& [key, value] : head.items())
    text += Json(key).dump() + ": " + value.dump() + ",\n";
  text += "\"cases\": [";
  const char* separator = "\n";
  for (const CaseFigures& figures : report.cases) {
    text += separator + json_of(figures).dump();
    separator = ",\n";
  }
  return text + "\n]}\n";
}

}  // namespace raytracer::bench
