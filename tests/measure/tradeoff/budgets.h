// Whether a budget of time is kept, and what error it brings.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/engine.h"
#include "tests/measure/scenes/named_scene.h"

namespace raytracer::published {

struct BudgetFigures {
  double budget_ms = 0;
  std::vector<double> trace_ms{};  ///< what tracing took, as Server-Timing says; by repetition
  std::vector<double> rmse{};      ///< true, by repetition
};

struct BudgetSceneFigures {
  std::string scene{};
  int exact_samples = 0;
  double exact_error = 0;                ///< estimated; see exact_picture.h
  std::vector<BudgetFigures> budgets{};  ///< rising
};

/// At 350 x 250, all scenes and budgets in turn.
std::vector<BudgetSceneFigures> measure_budgets(const std::vector<measure::NamedScene>& cases,
                                                const std::vector<double>& budgets_ms,
                                                int exact_samples, int repetitions,
                                                WorkerPool& pool);

struct BudgetVerdict {
  std::size_t count = 0;
  std::size_t kept_count = 0;   ///< within 5 % + 2 ms of the budget
  std::size_t step_count = 0;   ///< from one budget of a scene to the next
  std::size_t worse_count = 0;  ///< of these with a greater median error
};

bool keeps_budget(double trace_ms, double budget_ms);

BudgetVerdict judge(const std::vector<BudgetSceneFigures>& figures);

}  // namespace raytracer::published
