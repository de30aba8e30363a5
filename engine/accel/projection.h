// Where on the image a shape may be seen, a little generously.
#pragma once

#include <array>

#include "engine/accel/box.h"
#include "engine/math/vec.h"
#include "engine/pack/packed_scene.h"
#include "engine/plan/view.h"

namespace raytracer {

/// A rectangle of the image in pixels, y from the top down; empty if begin >= end.
struct PixelRectangle {
  double x_begin;
  double y_begin;
  double x_end;
  double y_end;
};

/// From frame coordinates to pixels, for shapes that the eye is not inside of.
class Projection {
 public:
  explicit Projection(const View& view);

  PixelRectangle of_sphere(const Vec3& center, double radius) const;
  PixelRectangle of_box(const Box& box) const;
  PixelRectangle of_triangle(const PackedTriangle& triangle) const;

  /// Of the part of a triangle that the image can show: a lower bound of its depth, the distance
  /// along the view's middle.
  double depth(const PackedTriangle& triangle) const;
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

/// The sides of a triangle on the image, which part what it may cover from what it does not.
class TriangleSides {
 public:
  TriangleSides(const View& view, const PackedTriangle& triangle);

  /// Whether the triangle may cover something of the rectangle that its own rectangle covers.
  bool reach(const PixelRectangle& pixels) const;

 private:
  /// Positive inside, linear over the image.
  struct Side {
    double at_origin;
    double per_column;
    double per_row;
  };
  std::array<Side, 3> sides_;
};

}  // namespace raytracer
