// Where a ray meets a plane: the definition, in double and one ray at a time.
#include <cmath>

#include "engine/math/ray_plane.h"
#include "engine/math/tolerances.h"
#include "engine/objects/plane/plane.h"

namespace raytracer {
namespace {

/// Whether it is not along the plane, but for what rounding makes of it and of the normal.
bool goes_across(const Vec3& direction, const Vec3& normal) {
  const double parts = std::abs(normal.x * direction.x) + std::abs(normal.y * direction.y) +
                       std::abs(normal.z * direction.z);
  return std::abs(dot(normal, direction)) > sine_noise<double> * parts;
}

}  // namespace

std::optional<SurfaceHit> intersect(const Ray& ray, const PackedPlane& plane) {
  if (ray.origin.is_on_surface(plane.id) || !goes_across(ray.direction, plane.normal)) return {};
  const auto hit = intersect_plane(ray, plane.point, plane.normal);
  if (!hit) return {};
  SurfacePoint point = flat_point(plane.id, ray, hit->t, plane.point, hit->normal);
  point.is_inside = dot(hit->normal, plane.normal) < 0;
  return SurfaceHit{hit->t, point};
}

}  // namespace raytracer
