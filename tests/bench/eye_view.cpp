#include "tests/bench/eye_view.h"

#include <cmath>

namespace raytracer::bench {

EyeView make_eye_view(const Camera& camera) {
  const Vec3 forward = unit(camera.look_at - camera.origin);
  const Vec3 u = unit(cross(camera.up, forward));
  const Vec3 v = cross(forward, u);
  const double half_width = std::tan(camera.fov / 2);
  return {forward, u * half_width, v * (half_width * camera.height / camera.width)};
}

}  // namespace raytracer::bench
