// What every report begins with: when, with what and on what machine it was made.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/measure/report/machine.h"

namespace raytracer::measure {

struct RunHead {
  std::string date;
  std::string commit;
  std::string command;
  std::size_t thread_count = 0;
  Machine machine{};
  std::vector<std::pair<std::string, std::string>> peers{};  ///< names and versions
};

/// A title and a list.
std::string to_markdown(const RunHead& head, const std::string& title);

nlohmann::ordered_json json_of(const RunHead& head);

/// To a tenth of a microsecond: the clock knows no more, and files stay short.
double rounded(double ms);

}  // namespace raytracer::measure
