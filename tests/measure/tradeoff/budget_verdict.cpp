// What is said of many budgets: a conclusion from budgets.h's figures that needs no renderer.

#include "tests/measure/report/median.h"
#include "tests/measure/tradeoff/budgets.h"

namespace raytracer::published {

bool keeps_budget(double trace_ms, double budget_ms) { return trace_ms <= 1.05 * budget_ms + 2; }

BudgetVerdict judge(const std::vector<BudgetSceneFigures>& figures) {
  BudgetVerdict verdict;
  for (const BudgetSceneFigures& scene : figures) {
    const BudgetFigures* before = nullptr;
    for (const BudgetFigures& budget : scene.budgets) {
      for (const double trace_ms : budget.trace_ms) {
        ++verdict.count;
        if (keeps_budget(trace_ms, budget.budget_ms)) ++verdict.kept_count;
      }
      if (before) {
        ++verdict.step_count;
        if (measure::median(budget.rmse) > measure::median(before->rmse)) ++verdict.worse_count;
      }
      before = &budget;
    }
  }
  return verdict;
}

}  // namespace raytracer::published
