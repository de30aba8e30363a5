#include "engine/plan/sampling.h"

#include <fmt/format.h>

#include "engine/errors/error_model.h"
#include "engine/text/pluralised.h"

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
  return fmt::format("{} per pixel {} asked for; {}", pluralised(count, "sample"),
                     count == 1 ? "is" : "are", where);
}

std::string why_contract(const RenderSettings& settings, std::optional<double> refined_to) {
  const std::string how =
      "a pilot pass of 4 samples per pixel, or 16 where objects may be smaller than a pixel, and "
      "under a budget 1 before it; then each pixel is refined as the variance of its samples and "
      "the difference of their half buffers demand";
  const std::string until =
      settings.target_rmse
          ? fmt::format(
                ", until the estimated RMSE and two of its standard deviations are at most {:g}{}",
                *refined_to,
                refined_to == settings.target_rmse
                    ? ""
                    : ", which is the target with a margin for subpixel lattices")
          : "";
  if (!settings.budget_ms) return how + until;
  return how + until +
         fmt::format("{} {:g} ms have passed", until.empty() ? ", until" : " or",
                     *settings.budget_ms);
}

}  // namespace

Sampling sampling_of(const RenderSettings& settings) {
  return settings.target_rmse || settings.budget_ms ? Sampling::contract : Sampling::fixed;
}

int pilot_samples(const SceneStatistics& statistics) {
  return statistics.all.subpixel > 0 ? RefinementModel::second_step : RefinementModel::first_step;
}

int first_samples(const RenderSettings& settings, const SceneStatistics& statistics) {
  const bool has_pilot = settings.target_rmse && !settings.budget_ms;
  return has_pilot ? pilot_samples(statistics) : settings.samples.value_or(1);
}

std::optional<double> refined_rmse(const RenderSettings& settings,
                                   const SceneStatistics& statistics) {
  if (!settings.target_rmse || !statistics.all.has_subpixel_lattice) return settings.target_rmse;
  return RefinementModel::lattice_margin * *settings.target_rmse;
}

Choice<Sampling> choose_sampling(const RenderSettings& settings,
                                 const SceneStatistics& statistics) {
  const Sampling sampling = sampling_of(settings);
  return {sampling, [settings, sampling, refined_to = refined_rmse(settings, statistics)] {
            return sampling == Sampling::fixed ? why_fixed(settings)
                                               : why_contract(settings, refined_to);
          }};
}

}  // namespace raytracer
