// Where a ray meets a sphere: the definition, in double and one ray at a time.
#include "engine/math/ray_sphere.h"
#include "engine/objects/sphere/sphere.h"

namespace raytracer {

std::optional<SurfaceHit> intersect(const Ray& ray, const PackedSphere& s) {
  const auto hit = intersect_sphere(ray, s.center, s.radius, ray.origin.is_on_surface(s.id));
  if (!hit) return {};
  return SurfaceHit{hit->t, round_point(s.id, s.center, s.radius, hit->outward, hit->is_inside)};
}

}  // namespace raytracer
