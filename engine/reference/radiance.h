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

/// Whether `light` counts at `point`: it is on the normal's side, and nothing is in between.
template <typename Finder>
bool is_visible(const ArrivingLight& light, const SurfacePoint& point, const Finder& finder,
                Shadows shadows) {
  if (!(dot(point.normal, light.towards) > 0)) return false;
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
          const Material& material, const Vec3& view) {
  const Rgb ambient = material.color * (material.ka * scene.ambient);
  Rgb sum;
  if (scene.shadows != Shadows::black) sum += ambient;
  for (const PackedLight& packed_light : scene.lights) {
    const ArrivingLight light = arriving_light(packed_light, point);
    if (!is_visible(light, point, finder, scene.shadows)) continue;
    if (scene.shadows == Shadows::black) sum += ambient;
    sum += direct_light(material, light, point.normal, view);
  }
  return sum;
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
    const Material& material = scene.material_of(point.id);
    sum += weight * shade(scene, finder, point, material, -ray.direction);

    weight *= material.reflectivity;
    if (!(weight > 0) || depth == scene.max_depth) return sum;
    ray = {point, unit(reflected(ray.direction, point.normal))};
  }
}

}  // namespace raytracer
