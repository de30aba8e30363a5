#include "engine/sample/pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace raytracer {
namespace {

/// Whether the points are symmetric about the centre. For other counts they are spread more evenly
/// if they are not.
bool is_symmetric(std::size_t count) { return count % 4 == 0; }

/// For each of `count` columns the row of its point, in the order of the golden ratio's multiples.
std::vector<std::size_t> golden_rows(std::size_t count) {
  constexpr double golden_ratio = 1 / std::numbers::phi;
  const double first = is_symmetric(count) ? 0.5 * (1 - static_cast<double>(count)) : 0.5;
  const double origin = is_symmetric(count) ? 0.5 : 0;
  std::vector<double> keys(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double multiple = origin + (first + static_cast<double>(k)) * golden_ratio;
    keys[k] = multiple - std::floor(multiple);
  }
  std::vector<std::size_t> by_key(count);
  std::iota(by_key.begin(), by_key.end(), std::size_t{0});
  std::sort(by_key.begin(), by_key.end(),
            [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  std::vector<std::size_t> rows(count);
  for (std::size_t rank = 0; rank < count; ++rank) rows[by_key[rank]] = rank;
  return rows;
}

}  // namespace

SamplePattern sample_pattern(int count) {
  // Over random edges the error of the covered area was least or near least among this,
  // Hammersley's points, rank-1 lattices and, for square counts, a grid, which fails along its own
  // directions.
  const auto size = static_cast<std::size_t>(count);
  const std::vector<std::size_t> rows = golden_rows(size);
  SamplePattern pattern;
  const auto add = [&](std::size_t k) {
    pattern.points.push_back(
        {(static_cast<double>(k) + 0.5) / count, (static_cast<double>(rows[k]) + 0.5) / count});
  };
  if (!is_symmetric(size)) {
    for (std::size_t k = 0; k < size; ++k) add(k);
    return pattern;
  }
  // A half buffer has every second column up to the middle, and their mirror images: two that had
  // not the same middle would differ where the picture is but a slope.
  for (const std::size_t parity : {std::size_t{0}, std::size_t{1}}) {
    for (std::size_t k = 0; k < size; ++k)
      if (std::min(k, size - 1 - k) % 2 == parity) add(k);
    if (parity == 0) pattern.half_a_count = pattern.points.size();
  }
  return pattern;
}

SamplePattern jittered_pattern(int count) {
  SamplePattern pattern = sample_pattern(count);
  pattern.jitter = 1.0 / count;
  return pattern;
}

}  // namespace raytracer
