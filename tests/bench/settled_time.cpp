#include "tests/bench/settled_time.h"

#include <cstddef>
#include <vector>

#include "tests/bench/median.h"

namespace raytracer::bench {

double settled_ms(const std::function<double()>& measure_ms) {
  constexpr double short_ms = 20;
  constexpr std::size_t fewest = 3;
  const double first_ms = measure_ms();
  if (first_ms >= short_ms) return first_ms;
  std::vector<double> times_ms;
  for (double all_ms = 0; all_ms < short_ms || times_ms.size() < fewest; all_ms += times_ms.back())
    times_ms.push_back(measure_ms());
  return median(times_ms);
}

}  // namespace raytracer::bench
