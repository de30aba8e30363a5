#include "engine/math/ray_plane.h"

#include <cmath>

#include "engine/math/tolerances.h"

namespace raytracer {

bool leaves_parallel(const SurfacePoint& from, const Vec3& normal) {
  return from.side == SurfacePoint::Side::flat &&
         max_abs(cross(from.normal, normal)) <= sine_noise<double>;
}

double height_over_surface(const SurfacePoint& from, const Vec3& point) {
  const double height = dot(from.normal, point - from.flat_point);
  const double noise = 16 * unit_roundoff<double> * (max_abs(point) + max_abs(from.flat_point));
  return std::abs(height) <= noise ? 0 : height;
}

std::optional<PlaneHit> intersect_plane(const Ray& ray, const Vec3& point, const Vec3& normal) {
  const SurfacePoint& from = ray.origin;
  const double height =
      leaves_parallel(from, normal)
          ? std::copysign(1.0, dot(normal, from.normal)) * height_over_surface(from, point)
          : dot(normal, point - from.anchor) - dot(normal, from.offset);
  const double slope = dot(normal, ray.direction);
  const double t = height / slope;
  if (!(t > 0) || std::isinf(t)) return {};
  return PlaneHit{t, slope > 0 ? -normal : normal};
}

}  // namespace raytracer
