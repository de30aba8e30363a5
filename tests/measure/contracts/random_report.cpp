#include "tests/measure/contracts/random_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "tests/measure/report/markdown_table.h"
#include "tests/measure/report/median.h"
#include "tests/measure/tradeoff/stop_text.h"

namespace raytracer::published {
namespace {

using measure::row;

constexpr double clearly_above = 2;    // adds at most 12 % to the error, mostly 4 %
constexpr double least_judged = 1e-4;  // a fortieth of a level of 8 bits; flat pictures have less

/// Of the estimate to the true error, where both are known well enough.
std::optional<double> judged_ratio(const MeasuredScene& scene, const MeasuredTarget& measured) {
  if (!measured.estimated_error ||
      measured.rmse < std::max(least_judged, clearly_above * scene.exact_error))
    return {};
  return *measured.estimated_error / measured.rmse;
}

bool is_kept(const MeasuredTarget& measured) { return measured.rmse <= measured.target; }

std::size_t count_unknown(const std::vector<MeasuredScene>& scenes) {
  std::size_t count = 0;
  for (const MeasuredScene& scene : scenes)
    count += static_cast<std::size_t>(
        std::count_if(scene.targets.begin(), scene.targets.end(),
                      [](const MeasuredTarget& each) { return !each.is_known; }));
  return count;
}

std::string share_text(std::size_t part, std::size_t all) {
  if (all == 0) return "-";
  return fmt::format("{} ({:.1f} %)", part,
                     100 * static_cast<double>(part) / static_cast<double>(all));
}

/// A table of the targets that `is_listed`.
template <typename IsListed>
std::string list_of(const char* title, const std::vector<MeasuredScene>& scenes,
                    const IsListed& is_listed) {
  std::string rows;
  for (const MeasuredScene& scene : scenes)
    for (const MeasuredTarget& each : scene.targets)
      if (is_listed(scene, each))
        rows += row(scene.seed, scene.summary, each.target, fmt::format("{:.4g}", each.rmse),
                    each.estimated_error ? fmt::format("{:.4g}", *each.estimated_error) : "-",
                    fmt::format("{:.4g}", each.samples_per_pixel), stop_text(each.stop),
                    fmt::format("{:.1g}, {}", scene.exact_error, scene.exact_samples));
  if (rows.empty()) return fmt::format("\n{}: none.\n", title);
  return fmt::format("\n{}:\n\n", title) +
         "| scene's seed | scene | target | true error | estimate | samples per pixel | ended by | "
         "exact picture: error, samples |\n|--:|---|--:|--:|--:|--:|---|--:|\n" +
         rows;
}

/// How far the exact pictures are to be trusted.
std::string exactness_text(const std::vector<MeasuredScene>& scenes) {
  std::vector<double> errors;
  errors.reserve(scenes.size());
  for (const MeasuredScene& scene : scenes) errors.push_back(scene.exact_error);
  return fmt::format("\nErrors of the exact pictures: median {:.2g}, the largest {:.2g}.\n",
                     measure::median(errors), *std::max_element(errors.begin(), errors.end()));
}

}  // namespace

TargetTally tally(const std::vector<MeasuredScene>& scenes, std::size_t index) {
  TargetTally tally;
  for (const MeasuredScene& scene : scenes) {
    const MeasuredTarget& measured = scene.targets.at(index);
    if (!measured.is_known) continue;
    ++tally.count;
    if (is_kept(measured)) ++tally.kept_count;
    const std::optional<double> ratio = judged_ratio(scene, measured);
    if (!ratio) continue;
    tally.least_ratio = tally.judged_count == 0 ? *ratio : std::min(tally.least_ratio, *ratio);
    tally.most_ratio = std::max(tally.most_ratio, *ratio);
    ++tally.judged_count;
    if (*ratio >= 1 / 2.0 && *ratio <= 2) ++tally.within_2_count;
    if (*ratio >= 1 / 2.5 && *ratio <= 2.5) ++tally.within_2_5_count;
    if (*ratio < 1 / 2.0) ++tally.below_half_count;
  }
  return tally;
}

bool is_enough(std::size_t kept_count, std::size_t count) { return 100 * kept_count >= 99 * count; }

std::string report_random(const std::vector<MeasuredScene>& scenes) {
  if (scenes.empty()) return "No scenes.\n";
  std::string text =
      "| target | kept | estimates judged | within a factor of 2 | of 2.5 | below half | the "
      "lowest, as a share of the error | the highest |\n|--:|--:|--:|--:|--:|--:|--:|--:|\n";
  std::size_t kept_count = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < scenes[0].targets.size(); ++i) {
    const TargetTally sum = tally(scenes, i);
    text += row(scenes[0].targets[i].target, fmt::format("{} of {}", sum.kept_count, sum.count),
                sum.judged_count, share_text(sum.within_2_count, sum.judged_count),
                share_text(sum.within_2_5_count, sum.judged_count),
                share_text(sum.below_half_count, sum.judged_count),
                measure::digits(sum.least_ratio), measure::digits(sum.most_ratio));
    kept_count += sum.kept_count;
    count += sum.count;
  }
  text += exactness_text(scenes);
  text += list_of("Estimates below half of the error", scenes,
                  [](const MeasuredScene& scene, const MeasuredTarget& each) {
                    return judged_ratio(scene, each).value_or(1) < 0.5;
                  });
  text += list_of("Targets that are not kept", scenes,
                  [](const MeasuredScene&, const MeasuredTarget& each) { return !is_kept(each); });
  text += fmt::format("\nIn all {} of {} renders of {} scenes keep their target: {}.\n", kept_count,
                      count, scenes.size(),
                      is_enough(kept_count, count) ? "enough" : "fewer than 99 %");
  if (const std::size_t unknown = count_unknown(scenes); unknown > 0)
    text += fmt::format(
        "{} more were not rendered: the exact picture is off by more than a third of the target.\n",
        unknown);
  return text;
}

}  // namespace raytracer::published
