#include "tests/measure/peers/eye_view.h"

#include <cmath>

namespace raytracer::peers {

EyeView make_eye_view(const Camera& camera) {
  const Vec3 forward = unit(camera.look_at - camera.origin);
  Vec3 across = cross(unit(camera.up), forward);
  if (length(across) < 1e-12) {
    const Vec3 size{std::abs(forward.x), std::abs(forward.y), std::abs(forward.z)};
    const Vec3 least_aligned = size.x <= size.z && size.x <= size.y ? Vec3{1, 0, 0}
                               : size.z <= size.y                   ? Vec3{0, 0, 1}
                                                                    : Vec3{0, 1, 0};
    across = cross(least_aligned, forward);
  }
  const Vec3 u = unit(across);
  const Vec3 v = cross(forward, u);
  const double half_width = std::tan(camera.fov / 2);
  return {forward, u * half_width, v * (half_width * camera.height / camera.width)};
}

}  // namespace raytracer::peers
