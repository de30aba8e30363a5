#include "engine/plan/sampling.h"

#include <fmt/format.h>

#include "engine/plan/counted.h"

namespace raytracer {
namespace {

std::string why_fixed(const RenderSettings& settings) {
  const auto count = static_cast<std::uint64_t>(settings.samples.value_or(1));
  const std::string where =
      count == 1 ? "it is taken at the pixel's centre"
                 : fmt::format(
                       "they are spread so that each of {0} columns and each of {0} rows "
                       "of a pixel has one",
                       grouped(count));
  if (!settings.samples)
    return "one per pixel, because neither a number nor an error nor a time is asked for; " + where;
  return fmt::format("{} per pixel {} asked for; {}", counted(count, "sample"),
                     count == 1 ? "is" : "are", where);
}

std::string why_contract(const RenderSettings& settings, std::optional<double> sought) {
  const std::string how =
      "four samples per pixel, or sixteen if spheres may be smaller than a pixel, under a budget "
      "one before them; then in each pixel as many as their variance and the difference between "
      "their halves ask for";
  if (settings.target_rmse && settings.budget_ms)
    return fmt::format("{}, until the estimated error is at most {:g} or {:g} ms are over", how,
                       *sought, *settings.budget_ms);
  if (settings.target_rmse)
    return fmt::format("{}, until the estimated error is at most {:g}", how, *sought);
  return fmt::format("{}, as many as fit into {:g} ms", how, *settings.budget_ms);
}

}  // namespace

Sampling sampling_of(const RenderSettings& settings) {
  return settings.target_rmse || settings.budget_ms ? Sampling::contract : Sampling::fixed;
}

int probing_samples(const Census& census) { return census.small_spheres > 0 ? 16 : 4; }

int first_samples(const RenderSettings& settings, const Census& census) {
  const bool is_probed = settings.target_rmse && !settings.budget_ms;
  return is_probed ? probing_samples(census) : settings.samples.value_or(1);
}

std::optional<double> sought_rmse(const RenderSettings& settings, const Census& census) {
  constexpr double least_estimate = 0.77;
  if (!settings.target_rmse || !census.has_small_squares) return settings.target_rmse;
  return least_estimate * *settings.target_rmse;
}

Choice<Sampling> choose_sampling(const RenderSettings& settings, const Census& census) {
  const Sampling sampling = sampling_of(settings);
  return {sampling, [settings, sampling, sought = sought_rmse(settings, census)] {
            return sampling == Sampling::fixed ? why_fixed(settings)
                                               : why_contract(settings, sought);
          }};
}

}  // namespace raytracer
