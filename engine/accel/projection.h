// Where on the image a shape may be seen, a little generously.
#pragma once

#include "engine/accel/box.h"
#include "engine/math/vec.h"
#include "engine/pack/view.h"

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
};

}  // namespace raytracer
