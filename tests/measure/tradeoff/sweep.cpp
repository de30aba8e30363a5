#include "tests/measure/tradeoff/sweep.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace raytracer::published {

std::vector<std::size_t> cheapest_few_within(const Sweep& sweep, double target, std::size_t most) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < sweep.size(); ++i)
    if (sweep[i].rmse <= target) places.push_back(i);
  std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
    return sweep[a].trace_ms < sweep[b].trace_ms;
  });
  if (places.size() > most) places.resize(most);
  return places;
}

std::optional<std::size_t> cheapest_within(const Sweep& sweep, double target) {
  const std::vector<std::size_t> places = cheapest_few_within(sweep, target, 1);
  return places.empty() ? std::nullopt : std::optional(places[0]);
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
