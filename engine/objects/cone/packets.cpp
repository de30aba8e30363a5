// How cones lie in memory, and what the eye and the lights know of them beforehand.
#include "engine/objects/cone/packets.h"

#include <algorithm>
#include <cmath>

namespace raytracer {

std::array<Line, 2> screen_outline(const View& view, const PackedCone& c) {
  // A tangent plane passes through the eye where its normal n, across the axis, has F.n = girth.
  const AxisBasis own(c);
  const double distance = c.cosine * length(c.foot);
  const double along = -(c.girth_at_foot / distance + 1e-9);  // generous by more than rounding
  if (!(std::abs(along) < 1)) return screen_lines<2>(view, {});
  const Vec3 inward = c.sine * c.axis - (c.cosine * along) * own.towards;
  const Vec3 aside = (c.cosine * std::sqrt((1 - along) * (1 + along))) * own.across;
  return screen_lines<2>(view, {inward + aside, inward - aside});
}

ShadowExtent shadow_extent(const PackedCone& c, const LightAxes& axes) {
  Box box;
  for (const bool is_to : {false, true}) {
    const Vec3 end = c.end(is_to);
    const Vec3 place{dot(end, axes[0]), dot(end, axes[1]), dot(end, axes[2])};
    const auto reach = [&](const Vec3& along) { return length(cross(c.axis, along)); };
    const Vec3 disc = c.radius(is_to) * Vec3{reach(axes[0]), reach(axes[1]), reach(axes[2])};
    box.include(Box{place - disc, place + disc});
  }
  return {box.low.x, box.low.y, box.high.x, box.high.y, box.high.z};
}

template <typename T>
ConeItem<T> PacketLayout<ConeKind, T>::item(const PackedCone& c, std::int32_t number) {
  const AxisBasis own(c);
  const auto girth2 = [&](bool is_to) {
    const double girth = c.cosine * c.radius(is_to);
    return static_cast<T>(girth * girth);
  };
  return {narrowed<T>(c.cosine * own.across),
          narrowed<T>(c.cosine * own.towards),
          narrowed<T>(own.axis),
          static_cast<T>(c.cosine * length(c.foot)),
          static_cast<T>(own.is_turned ? -c.sine : c.sine),
          static_cast<T>(c.girth_at_foot),
          static_cast<T>(own.is_turned ? -c.high : c.low),
          static_cast<T>(own.is_turned ? -c.low : c.high),
          girth2(own.is_turned),
          girth2(!own.is_turned),
          static_cast<T>(c.has_caps),
          static_cast<T>(number),
          static_cast<T>(c.eye_c)};
}

template <typename T>
void PacketLayout<ConeKind, T>::fill(const PackedCone& cone, std::int32_t number, std::size_t place,
                                     ConeBlock<T>& block) {
  const ConeItem<T> c = item(cone, number);
  const std::array<T, 9> axes{c.across.x,  c.across.y, c.across.z, c.towards.x, c.towards.y,
                              c.towards.z, c.axis.x,   c.axis.y,   c.axis.z};
  for (std::size_t i = 0; i < axes.size(); ++i) block.axes[i][place] = axes[i];
  block.distance[place] = c.distance;
  block.sine[place] = c.sine;
  block.girth[place] = c.girth;
  block.low[place] = c.low;
  block.high[place] = c.high;
  block.low_girth2[place] = c.low_girth2;
  block.high_girth2[place] = c.high_girth2;
  block.has_caps[place] = c.has_caps;
  block.id[place] = c.id;
}

template <typename T>
ConeLightView<T> PacketLayout<ConeKind, T>::light_view(std::span<const PackedCone> cones,
                                                       const PackedLight& light,
                                                       const FinderRow& finders,
                                                       const Numbering& numbers, WorkerPool& pool) {
  if (light.rays == LightRays::converging) {
    const Finder finder = finder_of(finders, RayKind::to_point_light);
    return {{}, lamp_view<PacketLayout, T>(cones, light.place, finder, numbers, pool)};
  }
  if (finder_of(finders, ray_kind_of(light)) != Finder::light_grid) return {};
  const auto outline_of = [axes = light_axes(light.place), cones](std::size_t i) {
    const PackedCone& c = cones[i];
    return strip_outline(axes, c.foot, c.axis, c.largest_radius());
  };
  return {build_list_grid<T>(light.place, cones, outline_of, pool), {}};
}

template struct PacketLayout<ConeKind, float>;
template struct PacketLayout<ConeKind, double>;

}  // namespace raytracer
