#include "tests/tradeoff/sweep.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace raytracer::published {

std::optional<std::size_t> cheapest_within(const Sweep& sweep, double target) {
  std::optional<std::size_t> cheapest;
  for (std::size_t i = 0; i < sweep.size(); ++i)
    if (sweep[i].rmse <= target && (!cheapest || sweep[i].trace_ms < sweep[*cheapest].trace_ms))
      cheapest = i;
  return cheapest;
}

double least_error(const Sweep& sweep) {
  double least = std::numeric_limits<double>::infinity();
  for (const SweepPoint& point : sweep) least = std::min(least, point.rmse);
  return least;
}

Sweep front(Sweep sweep) {
  std::sort(sweep.begin(), sweep.end(), [](const SweepPoint& a, const SweepPoint& b) {
    return a.trace_ms != b.trace_ms ? a.trace_ms < b.trace_ms : a.rmse < b.rmse;
  });
  Sweep best;
  for (SweepPoint& point : sweep)
    if (best.empty() || point.rmse < best.back().rmse) best.push_back(std::move(point));
  return best;
}

}  // namespace raytracer::published
