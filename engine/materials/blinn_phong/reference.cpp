// The definition of direct light, plain and in double.
#include <algorithm>
#include <cmath>

#include "engine/materials/blinn_phong/blinn_phong.h"

namespace raytracer {

Rgb direct_light(const BlinnPhong& material, const ArrivingLight& light, const Vec3& normal,
                 const Vec3& view) {
  const Vec3 half = unit(light.towards + view);
  const double highlight = std::pow(std::clamp(dot(half, normal), 0.0, 1.0), material.shininess);
  const double share = material.kd * dot(normal, light.towards) + material.ks * highlight;
  return material.color * share * light.intensity;
}

}  // namespace raytracer
