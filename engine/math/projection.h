// Where on the image a shape may be seen, a little generously.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "engine/math/box.h"
#include "engine/math/parts.h"
#include "engine/math/vec.h"
#include "engine/math/view.h"

namespace raytracer {

/// A rectangle of the image in pixels, y from the top down; empty if begin >= end.
struct PixelRectangle {
  double x_begin;
  double y_begin;
  double x_end;
  double y_end;
};

/// By so much rectangles are larger than what they hold.
inline constexpr double projection_margin_px = 0.01;

/// The range of x / z, or of y / z, under which something is seen.
struct Slopes {
  double low = infinity;
  double high = -infinity;

  void include(double slope) {
    low = std::min(low, slope);
    high = std::max(high, slope);
  }
};

/// From frame coordinates to pixels, for shapes that the eye is not inside of.
class Projection {
 public:
  explicit Projection(const View& view);

  PixelRectangle of_sphere(const Vec3& center, double radius) const;
  PixelRectangle of_box(const Box& box) const;
  /// Of everything between two discs across `axis` (unit).
  PixelRectangle of_discs(const Vec3& one, double one_radius, const Vec3& other,
                          double other_radius, const Vec3& axis) const;
  /// Of a triangle in a plane so far from the eye.
  PixelRectangle of_triangle(const std::array<Vec3, 3>& corners, double plane_distance) const;

  /// How deep a point lies: its distance along the view's middle.
  double depth(const Vec3& point) const { return dot(point, forward_); }
  /// How many times as far as deep what is seen in the rectangle is at least.
  double distance_per_depth(const PixelRectangle& pixels) const;

 private:
  /// Distances from the eye along the view's axes.
  struct Place {
    double x;
    double y;
    double z;
  };
  Place place(const Vec3& point) const;
  PixelRectangle rectangle(const Slopes& horizontal, const Slopes& vertical) const;
  double column(double slope) const { return (slope * columns_per_slope_) + middle_column_; }
  double row(double slope) const { return middle_row_ - (slope * rows_per_slope_); }

  Vec3 right_;
  Vec3 up_;
  Vec3 forward_;
  double columns_per_slope_;
  double rows_per_slope_;
  double middle_column_;
  double middle_row_;
  double most_distance_per_depth_;
};

/// What planes through the eye leave of the image, whose normals, of any length, are `inward`,
/// towards what is seen.
template <std::size_t count>
std::array<Line, count> screen_lines(const View& view, const std::array<Vec3, count>& inward) {
  std::array<Line, count> sides;
  for (std::size_t i = 0; i < count; ++i) {
    const double right = dot(inward[i], view.right);
    const double up = dot(inward[i], view.up);
    sides[i] = {dot(inward[i], view.forward) - right + up, 2 * right / view.width,
                -2 * up / view.height};
  }
  return sides;
}

/// The sides of a triangle, which part what it may cover from what it does not.
inline std::array<Line, 3> triangle_sides(const View& view, const std::array<Vec3, 3>& corners) {
  // By the sides themselves: corners that are far away differ by little.
  const auto& [a, b, c] = corners;
  const double sign = dot(cross(b - a, c - a), a) < 0 ? -1 : 1;
  std::array<Vec3, 3> inward;
  for (std::size_t i = 0; i < 3; ++i)
    inward[i] = sign * cross(corners[i], corners[(i + 1) % 3] - corners[i]);
  return screen_lines(view, inward);
}

}  // namespace raytracer
