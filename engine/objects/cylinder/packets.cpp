// How cylinders lie in memory, and what the eye and the lights know of them beforehand.
#include "engine/objects/cylinder/packets.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/chunks.h"

namespace raytracer {
namespace {

template <typename T>
CylinderShadow<T> shadow_of(const PackedCylinder& c, const Vec3& towards) {
  const Vec3 both = cross(towards, c.axis);
  const double slant = length(both);
  // Exactly across the axis, however nearly the light is along it: points lie far along it.
  const Vec3 k =
      slant > 1e-15 ? unit(both - dot(both, c.axis) * c.axis) : orthonormal_basis(c.axis).u;
  const Vec3 e = unit(cross(c.axis, k));
  const double slope = dot(towards, c.axis);
  const double most = sizeof(T) == sizeof(float) ? 1e15 : 1e30;
  const auto inverse = [most](double v) {
    return static_cast<T>(std::copysign(std::min(most, 1 / std::abs(v)), v));
  };
  return {narrowed<T>(k),
          narrowed<T>(e),
          narrowed<T>(c.axis),
          static_cast<T>(dot(c.foot, k)),
          static_cast<T>(dot(c.foot, e)),
          static_cast<T>(dot(c.foot, c.axis)),
          static_cast<T>(c.radius * c.radius),
          inverse(slant),
          inverse(slope),
          static_cast<T>(c.low),
          static_cast<T>(c.high)};
}

/// How far the disc of an end reaches along a unit vector.
double disc_reach(const PackedCylinder& c, const Vec3& along) {
  return c.radius * length(cross(c.axis, along));
}

}  // namespace

std::array<Line, 2> screen_outline(const View& view, const PackedCylinder& c) {
  const AxisBasis own(c);
  const double distance = length(c.foot);
  // Generous by more than rounding; an eye within sees it everywhere.
  const double sine = std::min(c.radius / distance * (1 + 1e-9), 1.0);
  if (!(c.eye_c > 0) || !(sine < 1)) return screen_lines<2>(view, {});
  const Vec3 inward = sine * own.towards;
  const Vec3 aside = std::sqrt((1 - sine) * (1 + sine)) * own.across;
  return screen_lines<2>(view, {inward + aside, inward - aside});
}

ShadowExtent shadow_extent(const PackedCylinder& c, const LightAxes& axes) {
  Box box;
  const Vec3 reach{disc_reach(c, axes[0]), disc_reach(c, axes[1]), disc_reach(c, axes[2])};
  for (const bool is_to : {false, true}) {
    const Vec3 end = c.end(is_to);
    const Vec3 place{dot(end, axes[0]), dot(end, axes[1]), dot(end, axes[2])};
    box.include(Box{place - reach, place + reach});
  }
  return {box.low.x, box.low.y, box.high.x, box.high.y, box.high.z};
}

template <typename T>
CylinderItem<T> PacketLayout<CylinderKind, T>::item(const PackedCylinder& c, std::int32_t number) {
  const AxisBasis own(c);
  return {narrowed<T>(own.across),
          narrowed<T>(own.towards),
          narrowed<T>(own.axis),
          static_cast<T>(length(c.foot)),
          static_cast<T>(c.radius * c.radius),
          static_cast<T>(c.eye_c),
          static_cast<T>(own.is_turned ? -c.high : c.low),
          static_cast<T>(own.is_turned ? -c.low : c.high),
          static_cast<T>(c.has_caps),
          static_cast<T>(number)};
}

template <typename T>
void PacketLayout<CylinderKind, T>::fill(const PackedCylinder& cylinder, std::int32_t number,
                                         std::size_t place, CylinderBlock<T>& block) {
  const CylinderItem<T> c = item(cylinder, number);
  const std::array<T, 9> axes{c.across.x,  c.across.y, c.across.z, c.towards.x, c.towards.y,
                              c.towards.z, c.axis.x,   c.axis.y,   c.axis.z};
  for (std::size_t i = 0; i < axes.size(); ++i) block.axes[i][place] = axes[i];
  block.distance[place] = c.distance;
  block.radius2[place] = c.radius2;
  block.low[place] = c.low;
  block.high[place] = c.high;
  block.has_caps[place] = c.has_caps;
  block.id[place] = c.id;
}

template <typename T>
CylinderLightView<T> PacketLayout<CylinderKind, T>::light_view(
    std::span<const PackedCylinder> cylinders, const PackedLight& light, const FinderRow& finders,
    const Numbering& numbers, WorkerPool& pool) {
  CylinderLightView<T> view;
  if (light.rays == LightRays::converging) {
    const Finder finder = finder_of(finders, RayKind::to_point_light);
    view.lamp = lamp_view<PacketLayout, T>(cylinders, light.place, finder, numbers, pool);
    return view;
  }
  view.shadows.resize(cylinders.size());
  for_each_range(cylinders.size(), pool, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      view.shadows[i] = shadow_of<T>(cylinders[i], light.place);
  });
  if (finder_of(finders, ray_kind_of(light)) != Finder::light_grid) return view;
  const auto outline_of = [axes = light_axes(light.place), cylinders](std::size_t i) {
    const PackedCylinder& c = cylinders[i];
    return strip_outline(axes, c.foot, c.axis, c.radius);
  };
  view.grid = build_list_grid<T>(light.place, cylinders, outline_of, pool);
  return view;
}

template struct PacketLayout<CylinderKind, float>;
template struct PacketLayout<CylinderKind, double>;

}  // namespace raytracer
