#include "tests/measure/tradeoff/budgets.h"

#include "engine/tradeoff/difference.h"
#include "tests/measure/tradeoff/exact_picture.h"

namespace raytracer::published {

std::vector<BudgetSceneFigures> measure_budgets(const std::vector<measure::NamedScene>& cases,
                                                const std::vector<double>& budgets_ms,
                                                int exact_samples, int repetitions,
                                                WorkerPool& pool) {
  Overrides size;
  size.width = 350;
  size.height = 250;
  std::vector<Scene> scenes;
  std::vector<ExactPicture> exact;
  std::vector<BudgetSceneFigures> figures;
  for (const measure::NamedScene& each : cases) {
    scenes.push_back(measure::read_document(each.document(), size));
    exact.push_back(render_exactly(scenes.back(), exact_samples, pool));
    BudgetSceneFigures scene{.scene = each.name,
                             .exact_samples = exact.back().samples,
                             .exact_error = exact.back().estimated_error};
    for (const double budget_ms : budgets_ms) {
      scene.budgets.emplace_back();
      scene.budgets.back().budget_ms = budget_ms;
    }
    figures.push_back(std::move(scene));
  }
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      for (BudgetFigures& budget : figures[i].budgets) {
        Overrides overrides;
        overrides.budget_ms = budget.budget_ms;
        const Rendering rendering = render_with(scenes[i], overrides, pool);
        budget.trace_ms.push_back(rendering.trace_ms);
        budget.rmse.push_back(difference(rendering.image, exact[i].image).rmse);
      }
    }
  }
  return figures;
}

}  // namespace raytracer::published
