// What is said of many targets.
#include <gtest/gtest.h>

#include "tests/measure/tradeoff/contracts.h"

namespace raytracer::published {
namespace {

ContractFigures scene(double exact_error, std::vector<KeptTarget> targets) {
  ContractFigures figures;
  figures.exact_error = exact_error;
  figures.targets = std::move(targets);
  return figures;
}

KeptTarget kept(double target, double rmse, std::optional<double> estimate) {
  return {.target = target, .rmse = rmse, .estimated_error = estimate};
}

TEST(ContractVerdict, target_is_kept_up_to_its_value) {
  const ContractVerdict verdict = judge(
      {scene(0, {kept(0.01, 0.01, {}), kept(0.01, 0.0101, {})}), scene(0, {kept(1, 0.5, {})})});
  EXPECT_EQ(verdict.count, 3U);
  EXPECT_EQ(verdict.kept_count, 2U);
  EXPECT_EQ(verdict.judged_count, 0U);
}

TEST(ContractVerdict, estimate_is_near_from_half_to_twice_the_true_error) {
  const ContractVerdict verdict =
      judge({scene(0, {kept(1, 0.5, 0.25), kept(1, 0.5, 1), kept(1, 0.5, 1.01)}),
             scene(0, {kept(1, 0.5, 0.24)})});
  EXPECT_EQ(verdict.judged_count, 4U);
  EXPECT_EQ(verdict.near_count, 2U);
  EXPECT_DOUBLE_EQ(verdict.least_ratio, 0.48);
}

TEST(ContractVerdict, estimate_of_an_error_that_cannot_be_told_is_not_judged) {
  const ContractVerdict verdict = judge({scene(0.01, {kept(1, 0.029, 1), kept(1, 0.031, 0.031)})});
  EXPECT_EQ(verdict.count, 2U);
  EXPECT_EQ(verdict.judged_count, 1U);
  EXPECT_EQ(verdict.near_count, 1U);
  EXPECT_EQ(verdict.least_ratio, 1);
}

}  // namespace
}  // namespace raytracer::published
