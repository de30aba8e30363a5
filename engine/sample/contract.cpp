#include "engine/sample/contract.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace raytracer {

std::optional<int> next_pass(const RenderSettings& settings, const PassReport& last,
                             int most_samples) {
  constexpr int growth = 4;
  constexpr double least_growth = 2;     // a smaller pass would hardly improve on the last
  constexpr double share_of_rest = 0.9;  // a pass may take longer than predicted

  if (settings.target_rmse && last.error && *last.error <= *settings.target_rmse) return {};
  double samples = std::min<double>(static_cast<double>(last.samples) * growth, most_samples);
  if (settings.budget_ms) {
    const double rest_ms = *settings.budget_ms - last.elapsed_ms;
    const double affordable = last.samples * share_of_rest * rest_ms / last.pass_ms;
    samples = std::min(samples, std::floor(affordable));
  }
  if (samples < least_growth * last.samples) return {};
  return static_cast<int>(samples);
}

int most_samples(const Scene& scene, const Limits& limits) {
  const std::int64_t pixels = std::int64_t{scene.camera.width} * scene.camera.height;
  const std::int64_t most = std::min({limits.samples, limits.work / pixels, std::int64_t{1} << 30});
  return static_cast<int>(std::max<std::int64_t>(most, 1));
}

double estimate_error(const Image& earlier, const Image& later, double ratio) {
  double sum = 0;
  for (std::size_t i = 0; i < later.values.size(); ++i) {
    const double difference =
        static_cast<double>(later.values[i]) - static_cast<double>(earlier.values[i]);
    sum += difference * difference;
  }
  const double rms = std::sqrt(sum / static_cast<double>(later.values.size()));
  return rms / (std::sqrt(ratio) - 1);
}

}  // namespace raytracer
