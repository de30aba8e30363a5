#include "tests/measure/tradeoff/settled_time.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "tests/measure/report/median.h"

namespace raytracer::published {

double settled_ms(const std::function<double()>& measure_ms) {
  constexpr double long_ms = 1000;
  constexpr double short_ms = 20;
  constexpr std::size_t fewest = 3;  // of what is short
  constexpr std::size_t most = 1000;
  const double first_ms = measure_ms();
  if (first_ms >= long_ms) return first_ms;
  std::vector<double> times_ms{measure_ms()};
  double all_ms = times_ms[0];
  if (all_ms >= short_ms) return all_ms;
  while (times_ms.size() < fewest || (all_ms < short_ms && times_ms.size() < most)) {
    times_ms.push_back(measure_ms());
    all_ms += times_ms.back();
  }
  return measure::median(std::move(times_ms));
}

}  // namespace raytracer::published
