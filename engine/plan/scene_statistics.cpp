#include "engine/plan/scene_statistics.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/parallel/sum.h"
#include "engine/plan/coincidence.h"
#include "engine/plan/magnification.h"
#include "engine/plan/shadow_reach.h"
#include "engine/scene/scene.h"

namespace raytracer {
namespace {

/// Of one kind's primitives.
template <typename Primitives>
GeometryStatistics statistics_of(const Primitives& primitives, const Viewpoint& from,
                                 WorkerPool* pool) {
  return sum_in_parts<GeometryStatistics>(
      primitives.size(), pool, [&](std::size_t begin, std::size_t end, GeometryStatistics& sum) {
        for (std::size_t i = begin; i < end; ++i) add_statistics(primitives[i], from, sum);
      });
}

std::array<GeometryStatistics, ObjectKinds::count> statistics_of_kinds(const PackedScene& packed,
                                                                       const Viewpoint& from,
                                                                       WorkerPool* pool) {
  std::array<GeometryStatistics, ObjectKinds::count> kinds;
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    kinds[kind_index<Kind>] = statistics_of(of_kind<Kind>(packed.primitives), from, pool);
  });
  return kinds;
}

GeometryStatistics together(const std::array<GeometryStatistics, ObjectKinds::count>& kinds) {
  GeometryStatistics all;
  for (const GeometryStatistics& kind : kinds) all.include(kind);
  return all;
}

/// Of those between corners whose normals differ: they turn as on something round.
void add_smooth_surfaces(const PackedScene& packed, GeometryStatistics& to) {
  if (packed.corner_values.empty()) return;
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    if constexpr (HasCorners<typename Kind::Primitive>)
      for (const auto& primitive : of_kind<Kind>(packed.primitives)) {
        const double distance = length(corners_of(primitive)[0]);
        to.least_sine = std::min(to.least_sine, smooth_radius(packed, primitive) / distance);
      }
  });
}

/// What the eye's distances are to the eye, a light's are to the light.
/// Returns its distance from the nearest surface.
double add_converging_light(const PackedScene& packed, const PackedLight& light, WorkerPool* pool,
                            SceneStatistics& to) {
  const auto kinds = statistics_of_kinds(
      packed, Viewpoint::at(light.place, packed.view, packed.frame.scene_origin()), pool);
  const GeometryStatistics all = together(kinds);
  double sought_from_points = infinity;
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    const double from =
        std::max(length(light.place), to.kinds[kind_index<Kind>].meeting_distance());
    to.light_clearance = std::min(to.light_clearance, kinds[kind_index<Kind>].clearance / from);
    if (is_sought_from_points<Kind>(of_kind<Kind>(packed.primitives).size(), to.pixels))
      sought_from_points = std::min(sought_from_points, kinds[kind_index<Kind>].clearance);
  });
  const double reach = std::max(all.farthest, to.farthest + to.all.visible_reach);
  to.shadow_spread = std::max(to.shadow_spread, reach / sought_from_points);
  to.lamps.push_back({light.place, sought_from_points, all.farthest});
  return all.clearance;
}

/// Of those that are points: rays to others go every way.
double lowest_light(const PackedScene& packed) {
  double lowest = 1;
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    if constexpr (Kind::search == Search::own)
      for (const auto& primitive : of_kind<Kind>(packed.primitives))
        for (const PackedLight& light : packed.lights)
          if (light.rays == LightRays::parallel)
            lowest = std::min(lowest, elevation_sine(primitive, light.place));
  });
  return lowest;
}

std::vector<GrazingLight> grazing_lights(const Scene& scene, const PackedScene& packed) {
  constexpr std::size_t most_named = 10;
  std::vector<GrazingLight> grazing;
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    if constexpr (HasGrazingLight<Kind>)
      for (const auto& primitive : of_kind<Kind>(packed.primitives))
        for (std::size_t i = 0; i < scene.lights.size() && grazing.size() < most_named; ++i)
          if (!is_soft(scene.lights[i]) &&
              is_grazed(primitive, pack_light(scene.lights[i], packed.frame)))
            grazing.push_back({i, primitive.id.object, kind_index<Kind>});
  });
  return grazing;
}

}  // namespace

SceneStatistics gather_statistics(const Scene& scene, const PackedScene& packed,
                                  const Features& features, WorkerPool* pool) {
  const Viewpoint eye = Viewpoint::at({}, packed.view, packed.frame.scene_origin());
  SceneStatistics statistics;
  statistics.kinds = statistics_of_kinds(packed, eye, pool);
  statistics.all = together(statistics.kinds);
  add_smooth_surfaces(packed, statistics.all);
  statistics.nearest = std::max(statistics.all.nearest, 0.0);
  statistics.lost = packed.lost;
  statistics.pixels = packed.view.pixel_count();
  statistics.pixel_angle = eye.pixel_angle;
  statistics.farthest = statistics.all.farthest;
  for (const Light& light : scene.lights) {
    const PackedLight packed_light = pack_light(light, packed.frame);
    if (packed_light.has_place())
      statistics.farthest = std::max(statistics.farthest, length(packed_light.place));
  }
  for (const Light& light : scene.lights) {
    const PackedLight packed_light = pack_light(light, packed.frame);
    double clearance = infinity;
    if (packed_light.has_place())
      clearance = add_converging_light(packed, packed_light, pool, statistics);
    std::visit(
        [&](const auto& source) {
          const double emitted = max_abs(light.color) * light.intensity;
          statistics.brightest =
              std::max(statistics.brightest,
                       brightest(source, emitted, std::ldexp(clearance, packed.frame.exponent())));
        },
        light.source);
  }
  statistics.shadows = shadow_reaches(packed, features, statistics, pool);
  if (features.reflects || features.transmits)
    statistics.magnification = magnification(packed, features, statistics.farthest);
  statistics.gap = least_gap(packed);
  statistics.lowest_light = lowest_light(packed);
  statistics.grazing = grazing_lights(scene, packed);
  return statistics;
}

}  // namespace raytracer
