// The pinhole camera: its documented fields, the rules that they obey and the view that they give.
#pragma once

#include <tuple>

#include "engine/fields/field_table.h"
#include "engine/math/vec.h"
#include "engine/math/view.h"

namespace raytracer {

struct Camera {
  Vec3 origin;
  Vec3 look_at;  ///< differs from origin
  Vec3 up{0, 1, 0};
  double fov = 0;  ///< between the left and the right side; modulo 2 pi inside (0, pi)
  int width = 0;   ///< pixels
  int height = 0;  ///< pixels

  /// As a double, because the product has no bound.
  double pixel_count() const { return static_cast<double>(width) * height; }

  static constexpr auto fields = std::tuple(
      required("origin", &Camera::origin, PointRule{}, "Where the eye is."),
      required("look_at", &Camera::look_at, OtherPointRule{"origin", "the camera has no direction"},
               "What the eye looks at; must differ from origin."),
      optional("up", &Camera::up, DirectionRule{}),
      required("fov", &Camera::fov, FieldOfViewRule{},
               "Radians between the left and the right side of the image."),
      required("width", &Camera::width, CountRule{1}, "Pixels."),
      required("height", &Camera::height, CountRule{1}, "Pixels."));
};

/// The view of a camera that obeys the rules (scene format, "Camera").
View make_view(const Camera& camera);

}  // namespace raytracer
