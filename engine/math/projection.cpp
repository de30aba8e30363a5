#include "engine/math/projection.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raytracer {
namespace {

/// The range of x / z over a circle around (x, z) in the plane, seen from the origin; all slopes
/// where the circle is not wholly in front of it.
Slopes slopes_of_circle(double x, double z, double r) {
  if (z <= r) return {-infinity, infinity};
  const double root = r * std::sqrt(std::max(x * x + z * z - r * r, 0.0));
  const double denominator = (z - r) * (z + r);
  return {(x * z - root) / denominator, (x * z + root) / denominator};
}

/// The range of x / z over a disc around (x, z) with its normal's part (wx, wz) there and wy
/// across; all slopes where the disc is not wholly in front.
Slopes slopes_of_disc(double x, double z, double wx, double wy, double wz, double r) {
  const double m11 = z * z - r * r * (1 - wz * wz);
  if (!(z > 0 && m11 > 0)) return {-infinity, infinity};
  const double m01 = x * z + r * r * wx * wz;
  const double along = x * wx + z * wz;
  const double root =
      r * std::sqrt(std::max((x * x + z * z - r * r) * wy * wy + along * along, 0.0));
  return {(m01 - root) / m11, (m01 + root) / m11};
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
      middle_row_(0.5 * view.height),
      most_distance_per_depth_(
          length(Vec3{middle_column_ / columns_per_slope_, middle_row_ / rows_per_slope_, 1})) {}

Projection::Place Projection::place(const Vec3& point) const {
  return {dot(point, right_), dot(point, up_), dot(point, forward_)};
}

PixelRectangle Projection::rectangle(const Slopes& horizontal, const Slopes& vertical) const {
  return {column(horizontal.low) - projection_margin_px, row(vertical.high) - projection_margin_px,
          column(horizontal.high) + projection_margin_px, row(vertical.low) + projection_margin_px};
}

PixelRectangle Projection::of_sphere(const Vec3& center, double radius) const {
  const Place at = place(center);
  if (at.z < -radius) return {0, 0, 0, 0};
  const Slopes horizontal = slopes_of_circle(at.x, at.z, radius);
  const Slopes vertical = slopes_of_circle(at.y, at.z, radius);
  return rectangle(horizontal, vertical);
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
  return rectangle(horizontal, vertical);
}

PixelRectangle Projection::of_discs(const Vec3& one, double one_radius, const Vec3& other,
                                    double other_radius, const Vec3& axis) const {
  const Place w = place(axis);
  Slopes horizontal;
  Slopes vertical;
  bool is_behind = true;
  for (const auto& [center, radius] : {std::pair(one, one_radius), {other, other_radius}}) {
    const Place at = place(center);
    is_behind = is_behind && at.z < -radius;
    const Slopes across = slopes_of_disc(at.x, at.z, w.x, w.y, w.z, radius);
    const Slopes up = slopes_of_disc(at.y, at.z, w.y, w.x, w.z, radius);
    for (const double slope : {across.low, across.high}) horizontal.include(slope);
    for (const double slope : {up.low, up.high}) vertical.include(slope);
  }
  if (is_behind) return {0, 0, 0, 0};
  return rectangle(horizontal, vertical);
}

PixelRectangle Projection::of_triangle(const std::array<Vec3, 3>& vertices,
                                       double plane_distance) const {
  // What the image shows of it lies deeper than this, at the distance of its plane or beyond.
  const double least_depth = plane_distance / most_distance_per_depth_ * (1 - 1e-9);
  std::array<Place, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = place(vertices[i]);
  Slopes horizontal;
  Slopes vertical;
  for (std::size_t i = 0; i < 3; ++i) {
    const Place& from = corners[i];
    const Place& to = corners[(i + 1) % 3];
    if (from.z >= least_depth && from.z > 0) {
      horizontal.include(from.x / from.z);
      vertical.include(from.y / from.z);
    }
    if ((from.z < least_depth) != (to.z < least_depth) && least_depth > 0) {
      const double share = (least_depth - from.z) / (to.z - from.z);
      horizontal.include((from.x + share * (to.x - from.x)) / least_depth);
      vertical.include((from.y + share * (to.y - from.y)) / least_depth);
    }
  }
  return rectangle(horizontal, vertical);
}

double Projection::distance_per_depth(const PixelRectangle& pixels) const {
  const double column = std::clamp(middle_column_, pixels.x_begin, pixels.x_end) - middle_column_;
  const double row = std::clamp(middle_row_, pixels.y_begin, pixels.y_end) - middle_row_;
  return length({column / columns_per_slope_, row / rows_per_slope_, 1});
}

}  // namespace raytracer
