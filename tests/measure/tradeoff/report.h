// The published trade as people read it (Markdown) and as programs do (JSON).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/measure/report/machine.h"
#include "tests/measure/tradeoff/budgets.h"
#include "tests/measure/tradeoff/contracts.h"
#include "tests/measure/tradeoff/equal_error.h"

namespace raytracer::published {

struct Report {
  std::string date{};
  std::string commit{};
  std::string command{};
  std::size_t thread_count = 0;
  bench::Machine machine{};
  std::string embree{};  ///< its version
  std::string povray{};
  ImageSize equal_error_size{};
  std::vector<EqualErrorFigures> equal_error{};
  std::vector<ContractFigures> contracts{};
  std::vector<std::string> skipped{};  ///< scenes whose exact picture would take too long
  std::vector<BudgetSceneFigures> budgets{};
};

std::string to_markdown(const Report& report);

std::string to_json(const Report& report);

}  // namespace raytracer::published
