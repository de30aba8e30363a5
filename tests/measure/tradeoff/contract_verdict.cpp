// What is said of many targets: a conclusion from contracts.h's figures that needs no renderer.

#include <algorithm>

#include "tests/measure/tradeoff/contracts.h"

namespace raytracer::published {

ContractVerdict judge(const std::vector<ContractFigures>& figures) {
  constexpr double clearly_above = 3;
  ContractVerdict verdict;
  for (const ContractFigures& scene : figures) {
    for (const KeptTarget& kept : scene.targets) {
      ++verdict.count;
      if (kept.rmse <= kept.target) ++verdict.kept_count;
      if (!kept.estimated_error || kept.rmse < clearly_above * scene.exact_error) continue;
      const double ratio = *kept.estimated_error / kept.rmse;
      verdict.least_ratio =
          verdict.judged_count == 0 ? ratio : std::min(verdict.least_ratio, ratio);
      ++verdict.judged_count;
      if (ratio >= 0.5 && ratio <= 2) ++verdict.near_count;
    }
  }
  return verdict;
}

}  // namespace raytracer::published
