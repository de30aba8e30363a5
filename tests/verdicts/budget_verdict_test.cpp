// What is said of many budgets.
#include <gtest/gtest.h>

#include "tests/measure/tradeoff/budgets.h"

namespace raytracer::published {
namespace {

TEST(BudgetVerdict, budget_has_five_percent_and_two_milliseconds_of_grace) {
  EXPECT_TRUE(keeps_budget(7.25, 5));
  EXPECT_FALSE(keeps_budget(7.26, 5));
  EXPECT_TRUE(keeps_budget(212, 200));
  EXPECT_FALSE(keeps_budget(212.1, 200));
}

TEST(BudgetVerdict, steps_compare_medians_within_a_scene) {
  const BudgetSceneFigures falling{
      .scene = "falling",
      .budgets = {
          {5, {5, 9}, {0.02, 0.02}}, {20, {20, 20}, {0.01, 0.03}}, {50, {50, 50}, {0.01, 0.01}}}};
  const BudgetSceneFigures rising{.scene = "rising",
                                  .budgets = {{5, {5}, {0.001}}, {20, {30}, {0.002}}}};
  const BudgetVerdict verdict = judge({falling, rising});
  EXPECT_EQ(verdict.count, 8U);
  EXPECT_EQ(verdict.kept_count, 6U);
  EXPECT_EQ(verdict.step_count, 3U);
  EXPECT_EQ(verdict.worse_count, 1U);
}

}  // namespace
}  // namespace raytracer::published
