#include "engine/math/axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytracer {
namespace {

/// A quarter of a - b, exactly, which no doubles make overflow, in frame units.
Split frame_difference(const Vec3& a, const Vec3& b, const Frame& frame) {
  return scaled(exact_difference(0.25 * a, 0.25 * b), 2 - frame.exponent());
}

/// a + (first + second) w in twice the precision: what a double holds of it, and the rest.
Split along_axis(const Split& a, double first, double second, const Split& w) {
  Split sum;
  for (const int axis : {0, 1, 2}) {
    CompensatedSum coordinate;
    coordinate.add(component(a.high, axis));
    coordinate.add_product(first, component(w.high, axis));
    coordinate.add_product(second, component(w.high, axis));
    coordinate.add(component(a.low, axis));
    coordinate.add_product(first, component(w.low, axis));
    component(sum.high, axis) = coordinate.total();
    component(sum.low, axis) = (coordinate.value - component(sum.high, axis)) + coordinate.rest;
  }
  return sum;
}

}  // namespace

double PlacedAxis::power_of_eye(double radius) const {
  const Vec3& foot = segment.foot;
  CompensatedSum power;
  for (const int axis : {0, 1, 2}) power.add_product(component(foot, axis), component(foot, axis));
  power.add_product(-radius, radius);
  power.add(2 * dot(foot, foot_rest));
  return power.total();
}

PlacedAxis place_axis(const Vec3& from, const Vec3& to, const Frame& frame) {
  const Split a = frame_difference(from, frame.eye(), frame);
  Split w = frame_difference(to, from, frame);
  const double longest = max_abs(w.high);
  if (!Frame::carries(longest)) return {{a.high, {1, 0, 0}, 0, 0}, {}};
  const int exponent = std::ilogb(longest);
  w = scaled(w, -exponent);
  const double square = dot(w.high, w.high);
  // The foot is a + (first + second) w: the second step takes away what the first left along w.
  const double first = -dot(a.high, w.high) / square;
  const double second = -dot(along_axis(a, first, 0, w).high, w.high) / square;
  const Split foot = along_axis(a, first, second, w);
  const double unit_of_w = std::sqrt(square);
  const double low = -(first + second) * unit_of_w;
  const double high = ((std::ldexp(1.0, exponent) - first) - second) * unit_of_w;
  return {{foot.high, unit(w.high), low, std::max(low, high)}, foot.low};
}

double AxisSegment::without_noise(double difference, double size) {
  constexpr double noise = 4096 * std::numeric_limits<double>::epsilon();
  return std::abs(difference) > noise * size ? difference : 0;
}

AxisSegment AxisSegment::seen_from(const Vec3& place) const {
  const Vec3 path = foot - place;
  const double along = dot(path, axis);
  return {path - along * axis, axis, without_noise(low + along, std::abs(along)),
          without_noise(high + along, std::abs(along))};
}

AxisBasis::AxisBasis(const AxisSegment& s) : is_turned(s.high < 0) {
  axis = is_turned ? -s.axis : s.axis;
  // Of an eye on the axis any direction across it will do; of another, what the foot's rounding
  // leaves along the axis is taken away.
  const Vec3 rest = s.foot - dot(s.foot, axis) * axis;
  towards = rest != Vec3{} ? unit(rest) : orthonormal_basis(axis).u;
  across = unit(cross(axis, towards));
}

Vec3 reach_of_disc(const Vec3& axis) {
  const Vec3 squares{axis.x * axis.x, axis.y * axis.y, axis.z * axis.z};
  return {std::sqrt(squares.y + squares.z), std::sqrt(squares.x + squares.z),
          std::sqrt(squares.x + squares.y)};
}

}  // namespace raytracer
