// A run of the bench as people read it (Markdown) and as programs do (JSON, every round).
#pragma once

#include <string>
#include <vector>

#include "tests/measure/bench/measure_case.h"
#include "tests/measure/report/run_head.h"

namespace raytracer::bench {

struct Report {
  measure::RunHead head;
  std::vector<CaseFigures> cases{};
};

std::string to_markdown(const Report& report);

std::string to_json(const Report& report);

}  // namespace raytracer::bench
