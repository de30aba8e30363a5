// The definition of refraction, plain and in double.
#include <cmath>

#include "engine/materials/glass/glass.h"

namespace raytracer {
namespace {

/// By one normal, which faces the ray.
RefractedRay refracted_by(const Glass& glass, const Vec3& direction, const Vec3& normal,
                          bool is_inside) {
  const double index = is_inside ? glass.ior : 1 / glass.ior;  // of here over there
  const double cosine = -dot(direction, normal);
  const double square = 1 - index * index * (1 - cosine * cosine);
  if (!(square > 0)) return {.direction = {}, .reflectance = 1, .is_total = true};
  const double beyond = std::sqrt(square);
  RefractedRay ray;
  ray.direction = unit(index * direction + (index * cosine - beyond) * normal);
  if (!glass.fresnel) return ray;
  const double across = (index * cosine - beyond) / (index * cosine + beyond);
  const double along = (index * beyond - cosine) / (index * beyond + cosine);
  ray.reflectance = 0.5 * (across * across + along * along);
  return ray;
}

}  // namespace

RefractedRay refracted(const Glass& glass, const Vec3& direction, const Vec3& normal,
                       const Vec3& surface_normal, bool is_inside) {
  if (dot(direction, normal) < 0) {
    const RefractedRay ray = refracted_by(glass, direction, normal, is_inside);
    if (ray.is_total || dot(ray.direction, surface_normal) < 0) return ray;
  }
  return refracted_by(glass, direction, surface_normal, is_inside);
}

}  // namespace raytracer
