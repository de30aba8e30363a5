// Where a ray meets a plane: the definition, in double and one ray at a time.
#include "engine/math/ray_plane.h"
#include "engine/objects/plane/plane.h"

namespace raytracer {

std::optional<SurfaceHit> intersect(const Ray& ray, const PackedPlane& plane) {
  if (ray.origin.is_on_surface(plane.id)) return {};
  const auto hit = intersect_plane(ray, plane.point, plane.normal);
  if (!hit) return {};
  SurfacePoint point = flat_point(plane.id, ray, hit->t, plane.point, hit->normal);
  point.is_inside = dot(hit->normal, plane.normal) < 0;
  return SurfaceHit{hit->t, point};
}

}  // namespace raytracer
