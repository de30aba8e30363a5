// The published trade as people read it (Markdown) and as programs do (JSON).
#pragma once

#include <string>
#include <vector>

#include "tests/measure/report/run_head.h"
#include "tests/measure/tradeoff/budgets.h"
#include "tests/measure/tradeoff/contracts.h"
#include "tests/measure/tradeoff/equal_error.h"

namespace raytracer::published {

struct Report {
  measure::RunHead head;
  std::vector<EqualErrorFigures> equal_error{};
  std::vector<ContractFigures> contracts{};
  std::vector<std::string> skipped{};  ///< scenes whose exact picture would take too long
  std::vector<BudgetSceneFigures> budgets{};
};

std::string to_markdown(const Report& report);

std::string to_json(const Report& report);

}  // namespace raytracer::published
