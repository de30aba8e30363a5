// The pinhole camera: image points to directions.
#pragma once

#include "engine/math/vec.h"

namespace raytracer {

/// The camera's basis with the field of view folded in; the eye is the frame's origin.
struct View {
  Vec3 forward;  ///< cos(fov/2) d
  Vec3 right;    ///< sin(fov/2) u: to the right side of the image
  Vec3 up;       ///< sin(fov/2) height/width v: to its upper side
  int width = 0;
  int height = 0;

  double pixel_count() const { return static_cast<double>(width) * height; }
  /// The unit direction through the image point (x, y) in pixels, y upwards from the lower edge.
  Vec3 direction(double x, double y) const {
    return unit(forward + right * (2 * x / width - 1) + up * (2 * y / height - 1));
  }
};

}  // namespace raytracer
