// What a ray sees: Blinn-Phong under hard shadows, and mirrors.
//
// The reference: plain, in double, one ray at a time. Faster kernels are held to its pixels.
#pragma once

#include <algorithm>
#include <limits>

#include "engine/math/ray.h"
#include "engine/pack/packed_scene.h"
#include "engine/reference/query.h"

namespace raytracer {

/// What of a light arrives at a point, kept finite: 0 times infinity would not be a number, and a
/// pixel is clamped to 1 anyway.
inline ArrivingLight arriving_light(const PackedLight& light, const SurfacePoint& point) {
  ArrivingLight result;
  LightKinds::for_each([&]<class Kind>(std::type_identity<Kind> kind) {
    if (light.kind == LightKinds::index_of<Kind>()) result = arriving(kind, light, point);
  });
  constexpr double most = std::numeric_limits<double>::max();
  Rgb& i = result.intensity;
  i = {std::min(i.x, most), std::min(i.y, most), std::min(i.z, most)};
  return result;
}

/// What shades a point: its normal and its material's colour, unless the corners around it tell
/// others.
struct PointShading {
  Vec3 normal;
  Material material;
};

inline PointShading shading_at(const PackedScene& scene, const SurfacePoint& point) {
  PointShading shading{point.normal, scene.material_of(point.id)};
  const CornerValues* const values = scene.corner_values_of(point.id);
  if (values == nullptr) return shading;
  const auto interpolated = [&](const std::vector<Vec3>& of) {
    const auto [a, b, c] = values->of(of, point.id.item);
    return point.weights.x * a + point.weights.y * b + point.weights.z * c;
  };
  if (!values->colors.empty()) shading.material.color = interpolated(values->colors);
  if (values->normals.empty()) return shading;
  const Vec3 normal = unit(interpolated(values->normals));
  if (normal != Vec3{}) shading.normal = point.part == back_part ? -normal : normal;
  return shading;
}

/// Whether `light` counts at `point`, which `normal` shades: it is on the side of that and of the
/// surface, and nothing is in between.
template <typename Finder>
bool is_visible(const ArrivingLight& light, const SurfacePoint& point, const Vec3& normal,
                const Finder& finder, Shadows shadows) {
  if (!(dot(normal, light.towards) > 0 && dot(point.normal, light.towards) > 0)) return false;
  if (shadows == Shadows::off) return true;
  const Ray ray{point, light.towards};
  // A light that lies in a surface is not hidden by it: there t is the distance but for rounding.
  constexpr double nearer = 1 - 0x1p-40;
  AnyHit query(ray, light.distance * nearer);
  finder.visit(query);
  return !query.found();
}

/// The colour of a point under all lights, without what it mirrors.
/// `view` is the unit vector towards the viewer.
template <typename Finder>
Rgb shade(const PackedScene& scene, const Finder& finder, const SurfacePoint& point,
          const PointShading& shading, const Vec3& view) {
  const Material& material = shading.material;
  const Rgb ambient = material.color * (material.ka * scene.ambient);
  Rgb sum;
  if (scene.shadows != Shadows::black) sum += ambient;
  for (const PackedLight& packed_light : scene.lights) {
    const ArrivingLight light = arriving_light(packed_light, point);
    if (!is_visible(light, point, shading.normal, finder, scene.shadows)) continue;
    if (scene.shadows == Shadows::black) sum += ambient;
    sum += direct_light(material, light, shading.normal, view);
  }
  return sum;
}

/// Where a mirror sends a ray: above its surface, so that a normal from corners that would send it
/// below does not count.
inline Vec3 mirrored(const Vec3& direction, const SurfacePoint& point, const Vec3& normal) {
  const Vec3 above = reflected(direction, normal);
  return unit(dot(above, point.normal) > 0 ? above : reflected(direction, point.normal));
}

/// The radiance that reaches the eye from `direction` (unit), not yet clamped.
template <typename Finder>
Rgb radiance(const PackedScene& scene, const Finder& finder, const Vec3& direction) {
  Ray ray{SurfacePoint{}, direction};
  Rgb sum;
  double weight = 1;  // of what this ray sees in the pixel
  for (int depth = 0;; ++depth) {
    NearestHit query(ray);
    finder.visit(query);
    if (!query.found()) return sum + weight * scene.background;

    const SurfacePoint point = query.point();
    const PointShading shading = shading_at(scene, point);
    sum += weight * shade(scene, finder, point, shading, -ray.direction);

    weight *= shading.material.reflectivity;
    if (!(weight > 0) || depth == scene.max_depth) return sum;
    ray = {point, mirrored(ray.direction, point, shading.normal)};
  }
}

}  // namespace raytracer
