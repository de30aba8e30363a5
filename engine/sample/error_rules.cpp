#include "engine/sample/error_rules.h"

#include <cmath>
#include <numeric>

namespace raytracer {

ErrorMultiplier choose_error_multiplier(const SceneStatistics& statistics) {
  using Model = SampleErrorModel;
  const auto initial = [](double fall) { return 1 / (std::exp2(fall) - 1); };
  if (statistics.all.subpixel > 0)
    return {initial(Model::random_fall), Model::least_subpixel_multiplier};
  return {initial((Model::random_fall + Model::edge_fall) / 2), Model::least_multiplier};
}

double sum_of(std::span<const double> errors2) {
  return std::accumulate(errors2.begin(), errors2.end(), 0.0);
}

double conservative_sum(std::span<const double> errors2) {
  double squares = 0;
  for (const double error2 : errors2) squares += error2 * error2;
  return sum_of(errors2) + SampleErrorModel::confidence_deviations * std::sqrt(2 * squares);
}

}  // namespace raytracer
