// What a ray sees: Blinn-Phong under hard shadows, mirrors and glass.
//
// The reference: plain, in double, one ray at a time. Faster kernels are held to its pixels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "engine/math/ray.h"
#include "engine/math/tolerances.h"
#include "engine/pack/packed_scene.h"
#include "engine/reference/query.h"

namespace raytracer {

/// What of a light arrives at a point, kept finite: 0 times infinity would not be a number, and a
/// pixel is clamped to 1 anyway.
inline ArrivingLight arriving_light(const PackedLight& light, const SurfacePoint& point) {
  ArrivingLight result;
  LightKinds::for_each([&]<class Kind>(std::type_identity<Kind> kind) {
    if constexpr (!ShinesFromEverywhere<Kind>)
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
  const auto interpolated = [&](const std::array<Vec3, 3>& of) {
    return point.weights.x * of[0] + point.weights.y * of[1] + point.weights.z * of[2];
  };
  if (!values->colors.empty())
    shading.material.color = interpolated(values->of(values->colors, point.id.item));
  if (values->normals.empty()) return shading;
  const Vec3 normal = unit(interpolated(values->normals_of(point.id.item)));
  if (normal != Vec3{}) shading.normal = point.is_inside ? -normal : normal;
  return shading;
}

/// How much reaches `point` of what shines from a direction, so far away: 0 unless that is on the
/// surface's side; what is in between hides it or weakens it.
template <typename Finder>
double share_along(const PackedScene& scene, const SurfacePoint& point, const Vec3& towards,
                   double distance, const Finder& finder) {
  if (!(dot(point.normal, towards) > 0)) return 0;
  if (scene.shadows == Shadows::off) return 1;
  const Ray ray{point, towards};
  if (!scene.transmits) {
    AnyHit query(ray, distance * nearer_than_light<double>);
    finder.visit(query);
    return query.found() ? 0 : 1;
  }
  const auto transparency_of = [&](const PrimitiveId& id) {
    return scene.material_of(id).transparency;
  };
  Transmission query(ray, distance * nearer_than_light<double>, transparency_of);
  finder.visit(query);
  return query.share();
}

inline std::span<const Vec3> places_of(const SoftLight& soft, const PlaceRange& range) {
  return std::span(soft.places).subspan(range.first, range.count);
}

/// How much of a disc that shines reaches a point: the mean over places on it.
template <typename Finder>
double share_of_disc(const PackedScene& scene, const SoftLight& soft, const ArrivingLight& middle,
                     const SurfacePoint& point, const PlaceRange& range, const Finder& finder) {
  const bool is_parallel = soft.light.rays == LightRays::parallel;
  const OrthonormalBasis around = orthonormal_basis(middle.towards);
  double sum = 0;
  for (const Vec3& place : places_of(soft, range)) {
    if (is_parallel) {
      sum += share_along(scene, point, place, infinity, finder);
      continue;
    }
    const Vec3 path = middle.distance * middle.towards +
                      soft.light.size * (place.x * around.u + place.y * around.v);
    sum += share_along(scene, point, unit(path), length(path), finder);
  }
  return sum / static_cast<double>(range.count);
}

/// How much of a sky reaches a point: the mean, by the cosine, over the ends of axes above it.
template <typename Finder>
double share_of_sky(const PackedScene& scene, const SoftLight& soft, const SurfacePoint& point,
                    const Vec3& normal, const PlaceRange& range, const Finder& finder) {
  double sum = 0;
  double weights = 0;
  for (const Vec3& axis : places_of(soft, range)) {
    const double cosine = dot(normal, axis);
    const Vec3 towards = cosine < 0 ? -axis : axis;
    weights += std::abs(cosine);
    sum += std::abs(cosine) * share_along(scene, point, towards, soft.light.size, finder);
  }
  return weights > 0 ? sum / weights : 0;
}

/// How much of a soft light reaches a point, by some of its places.
template <typename Finder>
double share_of_soft_light(const PackedScene& scene, const SoftLight& soft,
                           const SurfacePoint& point, const Vec3& normal, const PlaceRange& range,
                           const Finder& finder) {
  if (soft.light.shape == LightShape::sky)
    return share_of_sky(scene, soft, point, normal, range, finder);
  const ArrivingLight middle = arriving_light(soft.light, point);
  if (!(dot(normal, middle.towards) > 0)) return 0;
  return share_of_disc(scene, soft, middle, point, range, finder);
}

/// Whether a point that sees nothing of a soft light by its own set sees something of it.
template <typename Finder>
bool sees_any(const PackedScene& scene, const SoftLight& soft, const SurfacePoint& point,
              const Vec3& normal, std::size_t light_set, const Finder& finder) {
  const auto sees = [&](const PlaceRange& range) {
    return share_of_soft_light(scene, soft, point, normal, range, finder) > 0;
  };
  for (std::size_t i = 0; i < soft.numbers.rim_runs(); ++i)
    if (sees(soft.numbers.of_rim(i))) return true;
  for (int i = 1; i < scene.sets_to_be_sure; ++i)
    if (sees(soft.numbers.of_set((light_set + static_cast<std::size_t>(i)) % soft.numbers.sets)))
      return true;
  return false;
}

/// The colour that a point makes of a soft light, without the ambient part.
inline Rgb soft_light(const SoftLight& soft, const SurfacePoint& point, const PointShading& shading,
                      const Vec3& view) {
  const Material& material = shading.material;
  if (soft.light.shape == LightShape::sky)
    return material.kd * (material.color * soft.light.emission);
  return direct_light(material, arriving_light(soft.light, point), shading.normal, view);
}

/// Whether the light is on the normal's side: one that shines along a surface shines on no side of
/// it, whatever rounding makes of the point, the normal and the direction.
inline bool faces(const Vec3& normal, const ArrivingLight& light, const SurfacePoint& point) {
  constexpr double noise = sine_noise<double>;
  const double incidence = dot(normal, light.towards);
  return std::isinf(light.distance)
             ? incidence > noise
             : incidence * light.distance > noise * (light.distance + max_abs(point.point()));
}

/// The colour of a point under all lights, without what it mirrors.
/// `view` is the unit vector towards the viewer; `light_set`: of the places on soft lights.
template <typename Finder>
Rgb shade(const PackedScene& scene, const Finder& finder, const SurfacePoint& point,
          const PointShading& shading, const Vec3& view, std::size_t light_set) {
  const Material& material = shading.material;
  const Rgb ambient = material.color * (material.ka * scene.ambient);
  Rgb sum;
  if (scene.shadows != Shadows::black) sum += ambient;
  for (const PackedLight& packed_light : scene.lights) {
    const ArrivingLight light = arriving_light(packed_light, point);
    if (!faces(shading.normal, light, point)) continue;
    const double share = share_along(scene, point, light.towards, light.distance, finder);
    if (!(share > 0)) continue;
    if (scene.shadows == Shadows::black) sum += ambient;
    sum += share * direct_light(material, light, shading.normal, view);
  }
  for (const SoftLight& soft : scene.soft_lights) {
    const Vec3& normal = shading.normal;
    const double share =
        share_of_soft_light(scene, soft, point, normal, soft.numbers.of_set(light_set), finder);
    if (scene.shadows == Shadows::black &&
        (share > 0 || sees_any(scene, soft, point, normal, light_set, finder)))
      sum += ambient;
    if (share > 0) sum += share * soft_light(soft, point, shading, view);
  }
  return sum;
}

/// Where a mirror sends a ray: above its surface, so that a normal from corners that would send it
/// below does not count.
inline Vec3 mirrored(const Vec3& direction, const SurfacePoint& point, const Vec3& normal) {
  const Vec3 above = reflected(direction, normal);
  return unit(dot(above, point.normal) > 0 ? above : reflected(direction, point.normal));
}

/// A ray on its way.
struct WeightedRay {
  Ray ray;
  double weight = 1;  ///< of what it sees in the pixel
  int depth = 0;      ///< how many rays went before it
};

/// Adds those that follow a ray from the point that it has met.
inline void add_followers(const PackedScene& scene, const WeightedRay& before,
                          const SurfacePoint& point, const PointShading& shading,
                          std::vector<WeightedRay>& rays) {
  // Where rays branch those that count for nothing are left out.
  const double least_weight = scene.transmits ? least_ray_weight : 0;
  const Material& material = shading.material;
  const Vec3& direction = before.ray.direction;
  const auto add = [&](const SurfacePoint& from, const Vec3& towards, double share) {
    const double weight = before.weight * share;
    if (weight > 0 && weight >= least_weight)
      rays.push_back({{from, towards}, weight, before.depth + 1});
  };
  double reflectivity = material.reflectivity;
  if (material.transparency > 0) {
    if (!point.has_inside) {
      add(other_side(point), direction, material.transparency);
    } else {
      const auto on = refracted(material, direction, shading.normal, point.normal, point.is_inside);
      const double goes_on = on.is_total ? 0 : 1 - on.reflectance;
      reflectivity += material.transparency * (1 - goes_on);
      if (!on.is_total) add(other_side(point), on.direction, material.transparency * goes_on);
    }
  }
  if (reflectivity > 0) add(point, mirrored(direction, point, shading.normal), reflectivity);
}

/// What the eye sees in a direction.
struct Sight {
  Rgb radiance;  ///< not yet clamped
  bool meets_object = false;
};

/// `direction` is unit. `light_set` is that of what the eye sees itself, `followed_light_set`
/// that of what it sees in mirrors and through glass.
template <typename Finder>
Sight see(const PackedScene& scene, const Finder& finder, const Vec3& direction,
          std::size_t light_set = 0, std::size_t followed_light_set = 0) {
  Sight sight;
  Rgb& sum = sight.radiance;
  std::vector<WeightedRay> rays{{{SurfacePoint{}, direction}}};
  while (!rays.empty()) {
    const WeightedRay current = rays.back();
    rays.pop_back();
    NearestHit query(current.ray);
    finder.visit(query);
    if (!query.found()) {
      sum += current.weight * scene.background;
      continue;
    }
    sight.meets_object = true;  // others follow only what the eye's ray has met
    const SurfacePoint point = query.point();
    const PointShading shading = shading_at(scene, point);
    sum += current.weight * shade(scene, finder, point, shading, -current.ray.direction,
                                  current.depth == 0 ? light_set : followed_light_set);
    if (current.depth < scene.max_depth) add_followers(scene, current, point, shading, rays);
  }
  return sight;
}

}  // namespace raytracer
