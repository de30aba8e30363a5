// The report as Markdown tables: medians, for people.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "tests/measure/report/markdown_table.h"
#include "tests/measure/report/median.h"
#include "tests/measure/tradeoff/report.h"
#include "tests/measure/tradeoff/stop_text.h"

namespace raytracer::published {
namespace {

using measure::digits;
using measure::median;
using measure::row;

/// Two digits that count.
std::string error_text(double error) { return fmt::format("{:.2g}", error); }

std::string error_text(const std::optional<double>& error) {
  return error ? error_text(*error) : "-";
}

constexpr const char* heading =
    "Errors are root mean squares over all pixels and channels, before rounding to 8 bits, from "
    "the "
    "project's own picture of hundreds to thousands of samples per pixel in double precision, "
    "whose own error "
    "is estimated from the picture before it (see engine/tradeoff/reference.h). Times are "
    "milliseconds of tracing.\n";

constexpr const char* about_equal_error =
    "\n## At equal error\n\n"
    "The project is asked for the target. Embree takes a regular grid of n x n samples in every "
    "pixel by its fastest way to hand rays over; POV-Ray anti-aliases by its methods 1 and 2 with "
    "thresholds from 0.3 to 0 and growing depths, while that pays (3.7 has no method 3: it takes "
    "+AM3 as 2); Tachyon takes ever more samples at random places. Of each peer's settings the "
    "cheapest with an error of at most the target is run in turn with the project; what takes many "
    "seconds is not run in all rounds. The project and Embree run once more than is counted, and "
    "where that takes less than 20 ms again and again, for their median; programs once. Medians; "
    "ratios are medians of the rounds' ratios, above 1 where the project is faster; the scenes "
    "with the worst ratios come first. Under soft lights each of Embree's samples sees 1 x 1 to "
    "8 x 8 random places of each, one in each of its strata; its grids of more than 8 a side are "
    "then 10, 12, 14, 16, 19, 22, 25 and 29 a side, and all that fill packets. What a peer draws "
    "without ambient "
    "light is compared with a picture without it.\n\n";

std::string ratio_text(const TargetFigures& target, std::size_t peer, const PeerOutcome& outcome) {
  if (outcome.refusal) return "-";
  if (!target.peers[peer]) return "not reached";
  return digits(median_ratio(target, *target.peers[peer])) + 'x';
}

/// Of all targets and peers that reach them; infinite where none does.
double worst_ratio(const EqualErrorFigures& scene) {
  double worst = std::numeric_limits<double>::infinity();
  for (const TargetFigures& target : scene.targets)
    for (const std::optional<PeerFigures>& peer : target.peers)
      if (peer) worst = std::min(worst, median_ratio(target, *peer));
  return worst;
}

std::vector<EqualErrorFigures> by_worst_ratio(std::vector<EqualErrorFigures> scenes) {
  std::stable_sort(scenes.begin(), scenes.end(),
                   [](const auto& a, const auto& b) { return worst_ratio(a) < worst_ratio(b); });
  return scenes;
}

/// What the README shows.
std::string equal_error_table(const Report& report) {
  std::string text = "| scene | target | our error | estimate | samples | rounds | trace, ms |";
  std::string rule = "|:--|--:|--:|--:|--:|--:|--:|";
  for (const auto& [name, version] : report.head.peers) {
    text += fmt::format(" {} |", name);
    rule += "--:|";
  }
  text += '\n' + rule + '\n';
  for (const EqualErrorFigures& scene : by_worst_ratio(report.equal_error)) {
    for (const TargetFigures& target : scene.targets) {
      text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |", scene.scene, target.target,
                          error_text(target.rmse), error_text(target.estimated_error),
                          digits(target.samples_per_pixel), target.trace_ms.size(),
                          digits(median(target.trace_ms)));
      for (std::size_t i = 0; i < scene.peers.size(); ++i)
        text += fmt::format(" {} |", ratio_text(target, i, scene.peers[i]));
      text += '\n';
    }
  }
  return text;
}

std::string settings_table(const Report& report) {
  std::string text = "\nThe settings that these are:\n\n" +
                     row("scene", "target", "peer", "setting", "error", "trace") +
                     "|:--|--:|:--|:--|--:|--:|\n";
  for (const EqualErrorFigures& scene : report.equal_error)
    for (const TargetFigures& target : scene.targets)
      for (std::size_t i = 0; i < scene.peers.size(); ++i)
        if (const std::optional<PeerFigures>& peer = target.peers[i])
          text += row(scene.scene, target.target, scene.peers[i].name, peer->setting,
                      error_text(peer->rmse), digits(median(peer->trace_ms)));
  return text;
}

std::string about_peer(const PeerOutcome& peer, const EqualErrorFigures& scene, std::size_t i) {
  std::string text;
  if (peer.refusal) text += fmt::format("; {} cannot draw it: {}", peer.name, *peer.refusal);
  if (!peer.refusal && !scene.targets.back().peers[i])
    text += fmt::format("; {}'s least error is {}", peer.name, error_text(least_error(peer.sweep)));
  if (!peer.differences.empty())
    text += fmt::format("; {}: {}", peer.name, fmt::join(peer.differences, ", "));
  return text;
}

std::string equal_error_section(const Report& report) {
  std::string text = about_equal_error + equal_error_table(report) + settings_table(report);
  text += "\nThe scenes, their exact pictures, and what is known to be drawn differently:\n\n";
  for (const EqualErrorFigures& scene : report.equal_error) {
    text += fmt::format("- {}: {} x {} pixels, {} samples per pixel, off by at most {} by estimate",
                        scene.scene, scene.width_px, scene.height_px, scene.exact_samples,
                        error_text(scene.exact_error));
    for (std::size_t i = 0; i < scene.peers.size(); ++i)
      text += about_peer(scene.peers[i], scene, i);
    text += '\n';
  }
  return text;
}

std::string contract_section(const Report& report) {
  const ContractVerdict verdict = judge(report.contracts);
  std::string text = fmt::format(
      "\n## Targets kept\n\n"
      "Kept: {} of {} targets on {} scenes. The estimate (`Render-Error`) is within a factor of 2 "
      "of the true error in {} of {}; never below half of it: {} (the least is {:.2f} of it). "
      "Estimates are judged where the error is at least three times what the exact picture's is "
      "estimated to be.\n\n",
      verdict.kept_count, verdict.count, report.contracts.size(), verdict.near_count,
      verdict.judged_count, verdict.least_ratio >= 0.5 ? "yes" : "no", verdict.least_ratio);
  for (const std::string& scene : report.skipped)
    text += "- left out, its exact picture would take too long: " + scene + '\n';
  if (!report.skipped.empty()) text += '\n';
  text += row("scene", "size", "exact: samples", "its error", "target", "true error", "kept",
              "estimate / true", "samples", "stop", "trace");
  text += "|:--|--:|--:|--:|--:|--:|:--|--:|--:|:--|--:|\n";
  for (const ContractFigures& scene : report.contracts)
    for (const KeptTarget& kept : scene.targets)
      text += row(scene.scene, fmt::format("{} x {}", scene.width_px, scene.height_px),
                  scene.exact_samples, error_text(scene.exact_error), kept.target,
                  error_text(kept.rmse), kept.rmse <= kept.target ? "yes" : "**no**",
                  kept.estimated_error && kept.rmse > 0
                      ? fmt::format("{:.2f}", *kept.estimated_error / kept.rmse)
                      : "-",
                  digits(kept.samples_per_pixel), stop_text(kept.stop), digits(kept.trace_ms));
  return text;
}

std::string budget_section(const Report& report) {
  const BudgetVerdict verdict = judge(report.budgets);
  std::string text = fmt::format(
      "\n## Budgets kept\n\n"
      "350 x 250 pixels, scenes and budgets in turn. Tracing ended within the budget + 5 % + 2 ms "
      "in {} of {} renders. The median error is greater than with the next smaller budget in {} "
      "of {} steps.\n\n",
      verdict.kept_count, verdict.count, verdict.worse_count, verdict.step_count);
  text += row("scene", "budget", "renders", "kept", "median trace", "longest", "median error",
              "least", "greatest");
  text += "|:--|--:|--:|--:|--:|--:|--:|--:|--:|\n";
  for (const BudgetSceneFigures& scene : report.budgets) {
    for (const BudgetFigures& budget : scene.budgets) {
      const auto kept =
          std::count_if(budget.trace_ms.begin(), budget.trace_ms.end(),
                        [&](double ms) { return keeps_budget(ms, budget.budget_ms); });
      text += row(scene.scene, budget.budget_ms, budget.trace_ms.size(), kept,
                  digits(median(budget.trace_ms)),
                  digits(*std::max_element(budget.trace_ms.begin(), budget.trace_ms.end())),
                  error_text(median(budget.rmse)),
                  error_text(*std::min_element(budget.rmse.begin(), budget.rmse.end())),
                  error_text(*std::max_element(budget.rmse.begin(), budget.rmse.end())));
    }
  }
  text += "\nThe exact pictures:\n\n";
  for (const BudgetSceneFigures& scene : report.budgets)
    text += fmt::format("- {}: {} samples per pixel, off by at most {} by estimate\n", scene.scene,
                        scene.exact_samples, error_text(scene.exact_error));
  return text;
}

}  // namespace

std::string to_markdown(const Report& report) {
  std::string text = to_markdown(report.head, "What accuracy costs") + heading;
  if (!report.equal_error.empty()) text += equal_error_section(report);
  if (!report.contracts.empty()) text += contract_section(report);
  if (!report.budgets.empty()) text += budget_section(report);
  return text;
}

}  // namespace raytracer::published
