#include "engine/sample/pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace raytracer {

SamplePattern sample_pattern(int count) {
  // Columns in turn, rows in the order of the golden ratio's multiples: over random edges the
  // error of the covered area was least or near least among this, Hammersley's points, rank-1
  // lattices and, for square counts, a grid, which fails along its own directions.
  constexpr double golden_ratio = 1 / std::numbers::phi;
  const auto size = static_cast<std::size_t>(count);
  std::vector<double> keys(size);
  for (std::size_t k = 0; k < size; ++k) {
    const double multiple = (static_cast<double>(k) + 0.5) * golden_ratio;
    keys[k] = multiple - std::floor(multiple);
  }
  std::vector<std::size_t> by_key(size);
  std::iota(by_key.begin(), by_key.end(), std::size_t{0});
  std::sort(by_key.begin(), by_key.end(),
            [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });

  std::vector<SamplePoint> points(size);
  for (std::size_t rank = 0; rank < size; ++rank) {
    const std::size_t k = by_key[rank];
    points[k] = {(static_cast<double>(k) + 0.5) / count, (static_cast<double>(rank) + 0.5) / count};
  }
  return {std::move(points)};
}

SamplePattern staggered_pattern(int count) {
  SamplePattern pattern = sample_pattern(count);
  pattern.stagger = 1.0 / count;
  return pattern;
}

}  // namespace raytracer
