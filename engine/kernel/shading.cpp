#include "engine/kernel/shading.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytracer {
namespace {

/// Kept finite: 0 times infinity would not be a number, and a pixel is clamped to 1 anyway.
Rgb saturated(const Rgb& i) {
  constexpr double most = std::numeric_limits<double>::max();
  return {std::min(i.x, most), std::min(i.y, most), std::min(i.z, most)};
}

}  // namespace

Illumination illuminate(const PackedLight& light, const Departure& point) {
  if (light.is_distant)
    return {light.place, std::numeric_limits<double>::infinity(), saturated(light.emission)};
  const Vec3 path = (light.place - point.anchor) - point.offset;
  const double distance = length(path);
  // 0 / 0 where a channel is dark and the light at the point: dark.
  const auto fallen = [&](double emission) {
    return emission > 0 ? emission / distance / distance : 0;
  };
  return {
      unit(path), distance,
      saturated({fallen(light.emission.x), fallen(light.emission.y), fallen(light.emission.z)})};
}

Rgb direct_light(const Material& material, const Illumination& light, const Vec3& normal,
                 const Vec3& view) {
  const Vec3 half = unit(light.towards + view);
  const double highlight = std::pow(std::clamp(dot(half, normal), 0.0, 1.0), material.shininess);
  const double share = material.kd * dot(normal, light.towards) + material.ks * highlight;
  return material.color * share * light.intensity;
}

}  // namespace raytracer
