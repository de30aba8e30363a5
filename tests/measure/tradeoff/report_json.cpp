// The report as JSON: every figure of every round.

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/measure/report/machine_json.h"
#include "tests/measure/tradeoff/report.h"

namespace raytracer::published {
namespace {

using Json = nlohmann::ordered_json;

/// To a tenth of a microsecond: the clock knows no more, and the file stays short.
Json rounded(const std::vector<double>& times_ms) {
  Json json = Json::array();
  for (const double ms : times_ms) json.push_back(std::round(ms * 1e4) / 1e4);
  return json;
}

double rounded(double ms) { return std::round(ms * 1e4) / 1e4; }

Json json_of(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json json_of(const Sweep& sweep) {
  Json json = Json::array();
  for (const SweepPoint& point : sweep)
    json.push_back(
        {{"setting", point.setting}, {"trace_ms", rounded(point.trace_ms)}, {"rmse", point.rmse}});
  return json;
}

Json json_of(const std::optional<PeerFigures>& peer) {
  if (!peer) return {};
  return {{"setting", peer->setting}, {"rmse", peer->rmse}, {"trace_ms", rounded(peer->trace_ms)}};
}

Json json_of(const EqualErrorFigures& figures) {
  Json json{{"scene", figures.scene},
            {"exact_samples", figures.exact_samples},
            {"exact_error", figures.exact_error},
            {"with_samples", json_of(figures.with_samples)},
            {"with_target", json_of(figures.with_target)},
            {"embree", json_of(figures.embree)},
            {"povray", json_of(figures.povray)},
            {"embree_floor", figures.embree_floor}};
  for (const TargetFigures& target : figures.targets)
    json["targets"].push_back({{"target_rmse", target.target},
                               {"rmse", target.rmse},
                               {"estimated_error", json_of(target.estimated_error)},
                               {"samples_per_pixel", target.samples_per_pixel},
                               {"trace_ms", rounded(target.trace_ms)},
                               {"embree", json_of(target.embree)},
                               {"povray", json_of(target.povray)}});
  return json;
}

Json json_of(const ContractFigures& figures) {
  Json json{{"scene", figures.scene},
            {"is_shipped", figures.is_shipped},
            {"width", figures.width_px},
            {"height", figures.height_px},
            {"exact_samples", figures.exact_samples},
            {"exact_error", figures.exact_error}};
  for (const KeptTarget& kept : figures.targets)
    json["targets"].push_back({{"target_rmse", kept.target},
                               {"rmse", kept.rmse},
                               {"estimated_error", json_of(kept.estimated_error)},
                               {"samples_per_pixel", kept.samples_per_pixel},
                               {"is_target_reached", kept.stop == Stop::target},
                               {"trace_ms", rounded(kept.trace_ms)}});
  return json;
}

Json json_of(const BudgetSceneFigures& figures) {
  Json json{{"scene", figures.scene},
            {"exact_samples", figures.exact_samples},
            {"exact_error", figures.exact_error}};
  for (const BudgetFigures& budget : figures.budgets)
    json["budgets"].push_back({{"budget_ms", budget.budget_ms},
                               {"trace_ms", rounded(budget.trace_ms)},
                               {"rmse", budget.rmse}});
  return json;
}

/// A line for each entry: short files, and differences that can be read.
template <typename Figures>
std::string lines_of(const char* key, const std::vector<Figures>& all) {
  std::string text = std::string(",\n\"") + key + "\": [";
  const char* separator = "\n";
  for (const Figures& figures : all) {
    text += separator + json_of(figures).dump();
    separator = ",\n";
  }
  return text + "\n]";
}

}  // namespace

std::string to_json(const Report& report) {
  const Json head{{"date", report.date},
                  {"commit", report.commit},
                  {"command", report.command},
                  {"threads", report.thread_count},
                  {"machine", bench::json_of(report.machine)},
                  {"engine", build_id},
                  {"embree", report.embree},
                  {"povray", report.povray},
                  {"skipped", report.skipped}};
  return "{\"run\": " + head.dump() + lines_of("equal_error", report.equal_error) +
         lines_of("contracts", report.contracts) + lines_of("budgets", report.budgets) + "}\n";
}

}  // namespace raytracer::published
