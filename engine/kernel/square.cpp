#include "engine/kernel/square.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace raytracer {
namespace {

double component(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

double& component(Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

struct Interval {
  double begin;
  double end;

  bool empty() const { return !(begin <= end); }
};

/// The part of `t` in which |position + t slope| <= reach.
Interval clip(const Interval& t, double position, double slope, double reach) {
  if (slope == 0) return std::abs(position) <= reach ? t : Interval{1, 0};
  const double t1 = (-reach - position) / slope;
  const double t2 = (reach - position) / slope;
  return {std::max(t.begin, std::min(t1, t2)), std::min(t.end, std::max(t1, t2))};
}

/// A walk along a square: rows along `along`, one row for each index on the axis `rows`.
class Walk {
 public:
  Walk(const Ray& ray, const PackedSquare& square)
      : ray_(ray),
        square_(square),
        origin_((ray.from.anchor - square.center) + ray.from.offset),
        first_is_along_(std::abs(component(ray.direction, square.first_axis)) >=
                        std::abs(component(ray.direction, square.second_axis))),
        along_(first_is_along_ ? square.first_axis : square.second_axis),
        rows_(first_is_along_ ? square.second_axis : square.first_axis) {}

  std::optional<SquareHit> nearest() const {
    const double half = static_cast<double>(square_.side) * square_.radius;
    // A little more than the spheres' reach, against rounding: exactness is the spheres' affair.
    constexpr double slack = 1 + 0x1p-40;
    Interval t{0, std::numeric_limits<double>::infinity()};
    // A ray within the spheres' tangent plane would cross every row and touch at most points.
    constexpr double level = 0x1p-30;
    constexpr double not_tangent = 1 - 0x1p-32;
    const bool is_level = std::abs(slope(square_.across)) < level;
    t = clip(t, component(origin_, square_.across), slope(square_.across),
             square_.radius * (is_level ? not_tangent : slack));
    t = clip(t, component(origin_, along_), slope(along_), half * slack);
    t = clip(t, component(origin_, rows_), slope(rows_), half * slack);
    if (t.empty()) return {};

    const std::int64_t step = slope(rows_) < 0 ? -1 : 1;
    const double before = at(rows_, t.begin) / square_.radius;
    const double behind = at(rows_, t.end) / square_.radius;
    // A row more at either end, against rounding at the border between two.
    const std::int64_t first = clamp_index(index_at(before) - static_cast<double>(step));
    const std::int64_t last = clamp_index(index_at(behind) + static_cast<double>(step));
    for (std::int64_t row = first; step * row <= step * last; row += step)
      if (auto hit = nearest_in_row(row)) return hit;
    return {};
  }

 private:
  double slope(int axis) const { return component(ray_.direction, axis); }
  double at(int axis, double t) const { return component(origin_, axis) + t * slope(axis); }

  /// Where sphere `index` stands on its axis, in radii from the square's centre.
  double place(std::int64_t index) const {
    return static_cast<double>(2 * index + 1 - square_.side);
  }
  /// The index, not yet within the square, of the cell around `place` (in radii).
  double index_at(double place) const {
    return std::floor((place + static_cast<double>(square_.side)) / 2);
  }
  std::int64_t clamp_index(double index) const {
    return static_cast<std::int64_t>(std::clamp(index, 0.0, static_cast<double>(square_.side - 1)));
  }

  std::optional<SquareHit> nearest_in_row(std::int64_t row) const {
    // The ray against the row's axis, in the plane across it.
    const double r = square_.radius;
    const double side = component(origin_, rows_) - place(row) * r;
    const double height = component(origin_, square_.across);
    const double d_side = slope(rows_);
    const double d_height = slope(square_.across);
    const double sine2 = d_side * d_side + d_height * d_height;
    const double origin_along = component(origin_, along_);
    const std::int64_t step = slope(along_) < 0 ? -1 : 1;
    const double margin = static_cast<double>(step);  // a sphere more, against rounding

    // Behind the origin there is nothing to meet; the sphere around it may be met from inside.
    double begin = index_at(origin_along / r) - margin;
    double end = step > 0 ? static_cast<double>(square_.side - 1) : 0.0;
    if (sine2 > 0) {
      const double across = side * d_height - height * d_side;
      const double room = r * r - across * across / sine2;
      if (room < -0x1p-30 * r * r) return {};
      const double reach = std::sqrt(std::max(room, 0.0) / sine2);
      const double closest =
          origin_along - (side * d_side + height * d_height) / sine2 * slope(along_);
      const double first = index_at((closest - margin * reach) / r) - margin;
      const double last = index_at((closest + margin * reach) / r) + margin;
      begin = step > 0 ? std::max(begin, first) : std::min(begin, first);
      end = step > 0 ? std::min(end, last) : std::max(end, last);
    } else if (std::hypot(side, height) > r) {
      return {};
    }
    if (margin * begin > margin * end) return {};
    const std::int64_t first = clamp_index(begin);
    const std::int64_t last = clamp_index(end);
    for (std::int64_t index = first; step * index <= step * last; index += step)
      if (auto hit = intersect_one(index, row)) return hit;
    return {};
  }

  std::optional<SquareHit> intersect_one(std::int64_t along_index, std::int64_t row) const {
    const std::int64_t i = first_is_along_ ? along_index : row;
    const std::int64_t k = first_is_along_ ? row : along_index;
    const auto part = static_cast<std::uint64_t>(i * square_.side + k);
    Vec3 center = square_.center;
    component(center, square_.first_axis) += place(i) * square_.radius;
    component(center, square_.second_axis) += place(k) * square_.radius;
    const bool is_left = ray_.from.surface != Departure::Surface::none &&
                         ray_.from.id == PrimitiveId{square_.object, part};
    const auto hit = intersect_sphere(ray_, center, square_.radius, is_left);
    if (!hit) return {};
    return SquareHit{*hit, part, center};
  }

  const Ray& ray_;
  const PackedSquare& square_;
  Vec3 origin_;  ///< relative to the square's centre
  bool first_is_along_;
  int along_;  ///< the axis that rows run along
  int rows_;   ///< the axis on which rows lie side by side
};

}  // namespace

std::optional<SquareHit> intersect_square(const Ray& ray, const PackedSquare& square) {
  return Walk(ray, square).nearest();
}

}  // namespace raytracer
