// The report as Markdown tables: medians, for people.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/measure/report/markdown_table.h"
#include "tests/measure/report/median.h"
#include "tests/measure/tradeoff/report.h"
#include "tests/measure/tradeoff/stop_text.h"

namespace raytracer::published {
namespace {

using bench::digits;
using bench::median;
using bench::row;

/// Two digits that count.
std::string error_text(double error) { return fmt::format("{:.2g}", error); }

std::string error_text(const std::optional<double>& error) {
  return error ? error_text(*error) : "-";
}

std::string heading(const Report& report) {
  return fmt::format(
      "# What accuracy costs, {}, commit {}\n\n"
      "- processor: {}, {} cores, {}; {} threads for every program\n"
      "- system: {}; compiler: {}\n"
      "- Embree {}\n- POV-Ray {}\n"
      "- command: `{}`\n\n"
      "Errors are root mean squares over all pixels and channels, before rounding to 8 bits, from "
      "the project's own picture of thousands of samples per pixel in double precision, whose own "
      "error is estimated from the picture before it (see engine/tradeoff/reference.h). Times are "
      "milliseconds of tracing.\n",
      report.date, report.commit, report.machine.processor, report.machine.cores,
      report.machine.vectors, report.thread_count, report.machine.system, report.machine.compiler,
      report.embree, report.povray, report.command);
}

std::string peer_cells(const TargetFigures& target, const std::optional<PeerFigures>& peer) {
  if (!peer) return " not reached | | | |";
  return fmt::format(" {} | {} | {} | **{}x** |", peer->setting, error_text(peer->rmse),
                     digits(median(peer->trace_ms)), digits(median_ratio(target, *peer)));
}

std::string equal_error_section(const Report& report) {
  std::string text = fmt::format(
      "\n## At equal error\n\n"
      "{} x {} pixels. The project is asked for the target; Embree takes a regular grid of n x n "
      "samples in every pixel by its fastest way to hand rays over; POV-Ray anti-aliases by its "
      "methods 1 and 2 with thresholds from 0.3 to 0 and growing depths, while that pays (3.7 has "
      "no method 3: it takes +AM3 as 2). Of each peer's settings the cheapest with an error of at "
      "most the target is run in turn with the project; what takes many seconds is not run in all "
      "rounds. The project and Embree run once more than is counted, and where that takes less "
      "than 20 ms again and again, for their median; POV-Ray, which tells whole milliseconds, "
      "once. Medians; ratios are medians of the rounds' ratios, above 1 where the project is "
      "faster. \"demo\" has black shadows and the linear transfer here, which all draw. POV-Ray's "
      "pictures are of 16 bits, and compared with a picture without ambient light, which it counts "
      "differently.\n\n",
      report.equal_error_size.width_px, report.equal_error_size.height_px);
  text +=
      row("scene", "target", "rounds", "our error", "estimate", "samples", "trace", "Embree: grid",
          "error", "trace", "ratio", "POV-Ray: setting", "error", "trace", "ratio");
  text += "|:--|--:|--:|--:|--:|--:|--:|:--|--:|--:|--:|:--|--:|--:|--:|\n";
  for (const EqualErrorFigures& scene : report.equal_error) {
    for (const TargetFigures& target : scene.targets) {
      std::string cells = row(scene.scene, target.target, target.trace_ms.size(),
                              error_text(target.rmse), error_text(target.estimated_error),
                              digits(target.samples_per_pixel), digits(median(target.trace_ms)));
      cells.pop_back();  // the end of the line
      text += cells + peer_cells(target, target.embree) + peer_cells(target, target.povray) + '\n';
    }
  }
  text += "\nThe exact pictures:\n\n";
  for (const EqualErrorFigures& scene : report.equal_error) {
    text += fmt::format("- {}: {} samples per pixel, off by at most {} by estimate", scene.scene,
                        scene.exact_samples, error_text(scene.exact_error));
    if (scene.embree_floor > 0)
      text += fmt::format("; Embree is still off by {} with 48 x 48 samples",
                          error_text(scene.embree_floor));
    if (!scene.targets.back().povray)
      text += fmt::format("; POV-Ray's least error is {}", error_text(least_error(scene.povray)));
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
  text += row("scene", "shipped", "size", "exact: samples", "its error", "target", "true error",
              "kept", "estimate / true", "samples", "stop", "trace");
  text += "|:--|:--|--:|--:|--:|--:|--:|:--|--:|--:|:--|--:|\n";
  for (const ContractFigures& scene : report.contracts)
    for (const KeptTarget& kept : scene.targets)
      text += row(scene.scene, scene.is_shipped ? "yes" : "no",
                  fmt::format("{} x {}", scene.width_px, scene.height_px), scene.exact_samples,
                  error_text(scene.exact_error), kept.target, error_text(kept.rmse),
                  kept.rmse <= kept.target ? "yes" : "**no**",
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
  std::string text = heading(report);
  if (!report.equal_error.empty()) text += equal_error_section(report);
  if (!report.contracts.empty()) text += contract_section(report);
  if (!report.budgets.empty()) text += budget_section(report);
  return text;
}

}  // namespace raytracer::published
