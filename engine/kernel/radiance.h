// What a ray sees: Blinn-Phong under hard shadows, and mirrors.
//
// The reference: plain, in double, one ray at a time. Faster kernels are held to its pixels.
#pragma once

#include <cmath>

#include "engine/kernel/query.h"
#include "engine/kernel/shading.h"
#include "engine/math/ray.h"
#include "engine/pack/packed_scene.h"

namespace raytracer {

/// Whether `light` counts at `point`: it is on the normal's side, and nothing is in between.
template <typename Structure>
bool is_visible(const Illumination& light, const Departure& point, const Structure& structure,
                Shadows shadows) {
  if (!(dot(point.normal, light.towards) > 0)) return false;
  if (shadows == Shadows::off) return true;
  const Ray ray{point, light.towards};
  // A light that lies in a surface is not hidden by it: there t is the distance but for rounding.
  constexpr double nearer = 1 - 0x1p-40;
  AnyHit query(ray, light.distance * nearer);
  structure.visit(query);
  return !query.found();
}

/// The colour of a point under all lights, without what it mirrors.
/// `view` is the unit vector towards the viewer.
template <typename Structure>
Rgb shade(const PackedScene& scene, const Structure& structure, const Departure& point,
          const Material& material, const Vec3& view) {
  const Rgb ambient = material.color * (material.ka * scene.ambient);
  Rgb sum;
  if (scene.shadows != Shadows::black) sum += ambient;
  for (const PackedLight& packed_light : scene.lights) {
    const Illumination light = illuminate(packed_light, point);
    if (!is_visible(light, point, structure, scene.shadows)) continue;
    if (scene.shadows == Shadows::black) sum += ambient;
    sum += direct_light(material, light, point.normal, view);
  }
  return sum;
}

/// The radiance that reaches the eye from `direction` (unit), not yet clamped.
template <typename Structure>
Rgb radiance(const PackedScene& scene, const Structure& structure, const Vec3& direction) {
  Ray ray{Departure{}, direction};
  Rgb sum;
  double weight = 1;  // of what this ray sees in the pixel
  for (int depth = 0;; ++depth) {
    NearestHit query(ray);
    structure.visit(query);
    if (!query.found()) return sum + weight * scene.background;

    const Departure point = query.surface();
    const Material& material = scene.materials[scene.material_of_object[point.id.object]];
    sum += weight * shade(scene, structure, point, material, -ray.direction);

    weight *= material.reflectivity;
    if (!(weight > 0) || depth == scene.max_depth) return sum;
    ray = {point, unit(reflected(ray.direction, point.normal))};
  }
}

}  // namespace raytracer
