// A run of the bench as people read it (Markdown) and as programs do (JSON, every round).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/measure/bench/measure_case.h"
#include "tests/measure/report/machine.h"

namespace raytracer::bench {

struct Report {
  std::string date;
  std::string commit;
  std::string command{};
  std::size_t thread_count = 0;
  Machine machine{};
  std::optional<std::string> embree{};  ///< its version; absent where it took no part
  std::optional<std::string> povray{};
  std::vector<CaseFigures> cases{};
};

std::string to_markdown(const Report& report);

std::string to_json(const Report& report);

}  // namespace raytracer::bench
