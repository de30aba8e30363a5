// The report as JSON: every figure of every round.

#include <nlohmann/json.hpp>

#include "tests/measure/tradeoff/report.h"

namespace raytracer::published {
namespace {

using Json = nlohmann::ordered_json;

using measure::rounded;

Json rounded(const std::vector<double>& times_ms) {
  Json json = Json::array();
  for (const double ms : times_ms) json.push_back(rounded(ms));
  return json;
}

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
            {"width", figures.width_px},
            {"height", figures.height_px},
            {"exact_samples", figures.exact_samples},
            {"exact_error", figures.exact_error},
            {"with_samples", json_of(figures.with_samples)},
            {"with_target", json_of(figures.with_target)},
            {"peers", Json::array()}};
  for (const PeerOutcome& peer : figures.peers)
    json["peers"].push_back({{"name", peer.name},
                             {"refusal", peer.refusal ? Json(*peer.refusal) : Json()},
                             {"known_differences", peer.differences},
                             {"sweep", json_of(peer.sweep)}});
  for (const TargetFigures& target : figures.targets) {
    Json peers = Json::array();
    for (const std::optional<PeerFigures>& peer : target.peers) peers.push_back(json_of(peer));
    json["targets"].push_back({{"target_rmse", target.target},
                               {"rmse", target.rmse},
                               {"estimated_error", json_of(target.estimated_error)},
                               {"samples_per_pixel", target.samples_per_pixel},
                               {"trace_ms", rounded(target.trace_ms)},
                               {"peers", std::move(peers)}});
  }
  return json;
}

Json json_of(const ContractFigures& figures) {
  Json json{{"scene", figures.scene},
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
  Json head = json_of(report.head);
  head["skipped"] = report.skipped;
  return "{\"run\": " + head.dump() + lines_of("equal_error", report.equal_error) +
         lines_of("contracts", report.contracts) + lines_of("budgets", report.budgets) + "}\n";
}

}  // namespace raytracer::published
