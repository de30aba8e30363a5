#include "engine/math/parts.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace raytracer {
namespace {

constexpr std::size_t part_count = std::size_t{parts_across} * parts_across;

template <typename T>
using OfParts = std::array<T, part_count>;

/// value(column, row) of each.
template <typename T, typename Value>
constexpr OfParts<T> of_parts(const Value& value) {
  OfParts<T> values{};
  for (unsigned i = 0; i < part_count; ++i)
    values[i] = static_cast<T>(value(i % parts_across, i / parts_across));
  return values;
}

constexpr auto columns = of_parts<float>([](unsigned column, unsigned) { return column; });
constexpr auto rows = of_parts<float>([](unsigned, unsigned row) { return row; });
constexpr auto bits = of_parts<std::int32_t>(
    [](unsigned column, unsigned row) { return 1U << (parts_across * row + column); });

}  // namespace

PartLine part_line(const Line& line, double width, double height, double margin) {
  const double step_x = line.per_x * width / parts_across;
  const double step_y = line.per_y * height / parts_across;
  constexpr double not_zero = 1e-300;
  const double steps = 1 / std::max(std::abs(step_x) + std::abs(step_y), not_zero);
  const double inwards = std::max(step_x, 0.0) + std::max(step_y, 0.0) +
                         (std::abs(line.per_x) + std::abs(line.per_y)) * margin;
  return {{(line.at_origin + inwards) * steps, line.per_x * steps, line.per_y * steps},
          static_cast<float>(step_x * steps),
          static_cast<float>(step_y * steps)};
}

// Without a branch, and in a form that compilers make vectors of.
Parts parts_inside(std::span<const PartLine> lines, double x, double y) {
  OfParts<std::int32_t> outside{};  // where negative
  for (const PartLine& line : lines) {
    const double first =
        line.in_steps.at_origin + line.in_steps.per_x * x + line.in_steps.per_y * y;
    constexpr float rounding = 1e-5F;  // of what is no larger than 8
    const float start = static_cast<float>(std::clamp(first, -8.0, 8.0)) + rounding;
    const float along_row = line.along_row;
    const float along_column = line.along_column;
    for (std::size_t i = 0; i < part_count; ++i)
      outside[i] |=
          std::bit_cast<std::int32_t>(start + along_row * columns[i] + along_column * rows[i]);
  }
  std::int32_t inside = 0;
  for (std::size_t i = 0; i < part_count; ++i) inside |= ~(outside[i] >> 31) & bits[i];
  return static_cast<Parts>(inside);
}

}  // namespace raytracer
