// Where a ray meets a lattice: the definition, in double and one ray at a time, at a cost that does
// not depend on its size.

#include <algorithm>
#include <cmath>

#include "engine/math/ray_sphere.h"
#include "engine/objects/lattice/lattice.h"

namespace raytracer {
namespace {

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

/// A walk along a lattice: rows along `along`, one row for each index on the axis `rows`.
class Walk {
 public:
  Walk(const Ray& ray, const PackedLattice& lattice)
      : ray_(ray),
        lattice_(lattice),
        origin_((ray.origin.anchor - lattice.center) + ray.origin.offset),
        first_is_along_(std::abs(component(ray.direction, lattice.first_axis)) >=
                        std::abs(component(ray.direction, lattice.second_axis))),
        along_(first_is_along_ ? lattice.first_axis : lattice.second_axis),
        rows_(first_is_along_ ? lattice.second_axis : lattice.first_axis) {}

  std::optional<SurfaceHit> nearest() const {
    const double half = static_cast<double>(lattice_.side) * lattice_.radius;
    // A little more than the spheres' reach, against rounding: exactness is the spheres' affair.
    constexpr double slack = 1 + 0x1p-40;
    Interval t{0, infinity};
    // A ray within the spheres' tangent plane would cross every row and touch at most points.
    constexpr double level = 0x1p-30;
    constexpr double not_tangent = 1 - 0x1p-32;
    const bool is_level = std::abs(slope(lattice_.across)) < level;
    t = clip(t, component(origin_, lattice_.across), slope(lattice_.across),
             lattice_.radius * (is_level ? not_tangent : slack));
    t = clip(t, component(origin_, along_), slope(along_), half * slack);
    t = clip(t, component(origin_, rows_), slope(rows_), half * slack);
    if (t.empty()) return {};

    const std::int64_t step = slope(rows_) < 0 ? -1 : 1;
    const double before = at(rows_, t.begin) / lattice_.radius;
    const double behind = at(rows_, t.end) / lattice_.radius;
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
    return static_cast<double>(2 * index + 1 - lattice_.side);
  }
  /// The index, not yet within the square, of the cell around `place` (in radii).
  double index_at(double place) const {
    return std::floor((place + static_cast<double>(lattice_.side)) / 2);
  }
  std::int64_t clamp_index(double index) const {
    return static_cast<std::int64_t>(
        std::clamp(index, 0.0, static_cast<double>(lattice_.side - 1)));
  }

  std::optional<SurfaceHit> nearest_in_row(std::int64_t row) const {
    // The ray against the row's axis, in the plane across it.
    const double r = lattice_.radius;
    const double side = component(origin_, rows_) - place(row) * r;
    const double height = component(origin_, lattice_.across);
    const double d_side = slope(rows_);
    const double d_height = slope(lattice_.across);
    const double sine2 = d_side * d_side + d_height * d_height;
    const double origin_along = component(origin_, along_);
    const std::int64_t step = slope(along_) < 0 ? -1 : 1;
    const double margin = static_cast<double>(step);  // a sphere more, against rounding

    // Behind the origin there is nothing to meet; the sphere around it may be met from inside.
    double begin = index_at(origin_along / r) - margin;
    double end = step > 0 ? static_cast<double>(lattice_.side - 1) : 0.0;
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

  std::optional<SurfaceHit> intersect_one(std::int64_t along_index, std::int64_t row) const {
    const std::int64_t i = first_is_along_ ? along_index : row;
    const std::int64_t k = first_is_along_ ? row : along_index;
    const auto item = static_cast<std::uint64_t>(i * lattice_.side + k);
    Vec3 center = lattice_.center;
    component(center, lattice_.first_axis) += place(i) * lattice_.radius;
    component(center, lattice_.second_axis) += place(k) * lattice_.radius;
    const PrimitiveId id{lattice_.id.object, item};
    const auto hit = intersect_sphere(ray_, center, lattice_.radius, ray_.origin.is_on_surface(id));
    if (!hit) return {};
    return SurfaceHit{hit->t,
                      round_point(id, center, lattice_.radius, hit->outward, hit->is_inside)};
  }

  const Ray& ray_;
  const PackedLattice& lattice_;
  Vec3 origin_;  ///< relative to the square's centre
  bool first_is_along_;
  int along_;  ///< the axis that rows run along
  int rows_;   ///< the axis on which rows lie side by side
};

}  // namespace

std::optional<SurfaceHit> intersect(const Ray& ray, const PackedLattice& lattice) {
  return Walk(ray, lattice).nearest();
}

}  // namespace raytracer
