// How spheres lie in memory, and what the eye and the lights know of them beforehand.
#include "engine/objects/sphere/packets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace raytracer {
namespace {

/// In double up to the last step. A sphere in whose surface the light lies is a little smaller, by
/// what T rounds: it does not hide the light from outside.
template <typename T>
SphereBall<T> ball_seen_from(const Vec3& light, bool is_far, const PackedSphere& sphere,
                             std::int32_t number) {
  constexpr double noise = 4096 * std::numeric_limits<double>::epsilon();
  constexpr double shrink = 1 - 4096 * static_cast<double>(std::numeric_limits<T>::epsilon());
  const Vec3 from_light = sphere.center - light;
  const double distance = length(from_light);
  const bool is_in_surface = std::abs(distance - sphere.radius) <= noise * distance;
  const double radius = is_in_surface ? shrink * distance : sphere.radius;
  const Vec3 center = is_far ? sphere.center : from_light;
  return {static_cast<T>(center.x),
          static_cast<T>(center.y),
          static_cast<T>(center.z),
          static_cast<T>(radius * radius),
          static_cast<T>((distance - radius) * (1 - 1e-6)),
          static_cast<T>(number)};
}

template <typename T>
SphereDisc<T> disc_of(const PackedSphere& s, const LightAxes& axes, std::int32_t number) {
  return {static_cast<T>(dot(s.center, axes[0])), static_cast<T>(dot(s.center, axes[1])),
          static_cast<T>(dot(s.center, axes[2])), static_cast<T>(s.radius * s.radius),
          static_cast<T>(number)};
}

/// All in a single cell.
template <typename Grid, typename Make>
void fill_one_cell(std::span<const PackedSphere> spheres, const Make& make, Grid& grid) {
  std::vector<decltype(make(spheres[0]))> casters;
  casters.reserve(spheres.size());
  for (const PackedSphere& sphere : spheres) casters.push_back(make(sphere));
  using Caster = typename decltype(casters)::value_type;
  grid.begins = {0, static_cast<std::uint32_t>(casters.size())};
  grid.casters.resize(casters.size());
  grid.casters.write(0, std::span<const Caster>(casters), Caster::members);
}

}  // namespace

template <typename T>
SphereLightView<T> PacketLayout<SphereKind, T>::light_view(std::span<const PackedSphere> spheres,
                                                           const PackedLight& light,
                                                           const FinderRow& finders,
                                                           const Numbering& numbers,
                                                           WorkerPool& pool) {
  SphereLightView<T> view;
  if (light.is_opposite) return view;  // the other end's serves both
  if (light.rays == LightRays::parallel) {
    const auto make = [&numbers](const PackedSphere& s, const LightAxes& axes) {
      return disc_of<T>(s, axes, numbers(s.id));
    };
    if (finder_of(finders, RayKind::to_distant_light) == Finder::light_grid) {
      view.discs = build_caster_grid<SphereDisc<T>, T>(light.place, spheres, make, pool);
    } else if (finder_of(finders, RayKind::to_distant_light) == Finder::one_by_one) {
      const LightAxes axes = light_axes(light.place);
      view.discs.plane.axes = in_precision<T>(axes);
      fill_one_cell(
          spheres, [&](const PackedSphere& s) { return make(s, axes); }, view.discs);
    }
    return view;
  }
  const double reach = reach_of(spheres, pool);
  view.is_far = is_far_light(light.place, reach);
  const auto make = [&, is_far = view.is_far](const PackedSphere& s) {
    return ball_seen_from<T>(light.place, is_far, s, numbers(s.id));
  };
  if (finder_of(finders, RayKind::to_point_light) == Finder::point_grid)
    view.balls = build_point_grid<SphereBall<T>, T>(light.place, spheres, reach, make, pool);
  else if (finder_of(finders, RayKind::to_point_light) == Finder::one_by_one)
    fill_one_cell(spheres, make, view.balls);
  return view;
}

template struct PacketLayout<SphereKind, float>;
template struct PacketLayout<SphereKind, double>;

}  // namespace raytracer
