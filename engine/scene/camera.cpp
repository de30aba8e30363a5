#include "engine/scene/camera.h"

#include <cmath>

namespace raytracer {
namespace {

/// The axis least aligned with d; of equals x, then z, then y.
Vec3 least_aligned_axis(const Vec3& d) {
  const double x = std::abs(d.x);
  const double y = std::abs(d.y);
  const double z = std::abs(d.z);
  if (x <= z && x <= y) return {1, 0, 0};
  return z <= y ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
}

}  // namespace

View make_view(const Camera& camera) {
  constexpr double parallel = 1e-12;
  Vec3 sight = camera.look_at - camera.origin;
  // The difference of two doubles may overflow; that of their halves has the same direction.
  if (!std::isfinite(max_abs(sight))) sight = camera.look_at * 0.5 - camera.origin * 0.5;
  const Vec3 d = unit(sight);
  Vec3 across = cross(unit(camera.up), d);
  if (length(across) < parallel) across = cross(least_aligned_axis(d), d);
  const Vec3 u = unit(across);
  const Vec3 v = cross(d, u);
  // Sine and cosine instead of the tangent, which has no bound near pi. For an angle beyond
  // 2 pi both may be negative together: the same tangent.
  const double sine = std::abs(std::sin(camera.fov / 2));
  const double cosine = std::abs(std::cos(camera.fov / 2));
  const double aspect = static_cast<double>(camera.height) / camera.width;
  return {d * cosine, u * sine, v * (sine * aspect), camera.width, camera.height};
}

}  // namespace raytracer
