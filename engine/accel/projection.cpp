#include "engine/accel/projection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytracer {
namespace {

constexpr double generosity_px = 0.01;
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Slopes {
  double low = infinity;
  double high = -infinity;

  void include(double slope) {
    low = std::min(low, slope);
    high = std::max(high, slope);
  }
};

/// The range of x / z over a circle around (x, z) in the plane, seen from the origin; all slopes
/// where the circle is not wholly in front of it.
Slopes slopes_of_circle(double x, double z, double r) {
  if (z <= r) return {-infinity, infinity};
  const double root = r * std::sqrt(std::max(x * x + z * z - r * r, 0.0));
  const double denominator = (z - r) * (z + r);
  return {(x * z - root) / denominator, (x * z + root) / denominator};
}

}  // namespace

Projection::Projection(const View& view)
    : right_(unit(view.right)),
      up_(unit(view.up)),
      forward_(unit(view.forward)),
      // The view's vectors carry the field of view.
      columns_per_slope_(length(view.forward) / length(view.right) * 0.5 * view.width),
      rows_per_slope_(length(view.forward) / length(view.up) * 0.5 * view.height),
      middle_column_(0.5 * view.width),
      middle_row_(0.5 * view.height) {}

Projection::Place Projection::place(const Vec3& point) const {
  return {dot(point, right_), dot(point, up_), dot(point, forward_)};
}

PixelRectangle Projection::of_sphere(const Vec3& center, double radius) const {
  const Place at = place(center);
  if (at.z < -radius) return {0, 0, 0, 0};
  const Slopes horizontal = slopes_of_circle(at.x, at.z, radius);
  const Slopes vertical = slopes_of_circle(at.y, at.z, radius);
  return {column(horizontal.low) - generosity_px, row(vertical.high) - generosity_px,
          column(horizontal.high) + generosity_px, row(vertical.low) + generosity_px};
}

PixelRectangle Projection::of_box(const Box& box) const {
  constexpr int corners = 8;
  Slopes horizontal;
  Slopes vertical;
  const auto corner = [&](int i) {
    return place({(i & 1) != 0 ? box.high.x : box.low.x, (i & 2) != 0 ? box.high.y : box.low.y,
                  (i & 4) != 0 ? box.high.z : box.low.z});
  };
  for (int i = 0; i < corners; ++i) {
    const Place from = corner(i);
    if (from.z > 0) {
      horizontal.include(from.x / from.z);
      vertical.include(from.y / from.z);
    }
    for (int axis = 1; axis < corners; axis *= 2) {
      const Place to = corner(i ^ axis);
      if (!(from.z > 0 && to.z <= 0)) continue;
      // Where the edge leaves what lies ahead it is seen infinitely far to some side.
      const double share = from.z / (from.z - to.z);
      const double x = from.x + share * (to.x - from.x);
      const double y = from.y + share * (to.y - from.y);
      if (x != 0) horizontal.include(std::copysign(infinity, x));
      if (y != 0) vertical.include(std::copysign(infinity, y));
    }
  }
  return {column(horizontal.low) - generosity_px, row(vertical.high) - generosity_px,
          column(horizontal.high) + generosity_px, row(vertical.low) + generosity_px};
}

}  // namespace raytracer
