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

}  // namespace

std::array<Line, 2> screen_outline(const View& view, const PackedCylinder& c) {
  const AxisBasis own(c);
  const double distance = length(c.foot);
  // Generous by more than rounding; an eye within sees it everywhere.
  const double sine = std::min(c.radius / distance * (1 + 1e-9), 1.0);
  if (!(c.eye_power > 0) || !(sine < 1)) return screen_lines<2>(view, {});
  const Vec3 inward = sine * own.towards;
  const Vec3 aside = std::sqrt((1 - sine) * (1 + sine)) * own.across;
  return screen_lines<2>(view, {inward + aside, inward - aside});
}

template <typename T>
CylinderItem<T> PacketLayout<CylinderKind, T>::item(const PackedCylinder& c, std::int32_t number) {
  return {AxialItem<T>::of(c, AxisBasis(c), number), static_cast<T>(c.radius * c.radius)};
}

template <typename T>
CylinderLightView<T> PacketLayout<CylinderKind, T>::light_view(
    std::span<const PackedCylinder> cylinders, const PackedLight& light, const FinderRow& finders,
    const Numbering& numbers, WorkerPool& pool) {
  using Axial = typename PacketLayout::AxialLayout;
  CylinderLightView<T> view{Axial::light_view(cylinders, light, finders, numbers, pool), {}};
  if (light.rays == LightRays::converging) return view;
  view.shadows.resize(cylinders.size());
  for_each_range(cylinders.size(), pool, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      view.shadows[i] = shadow_of<T>(cylinders[i], light.place);
  });
  return view;
}

template struct PacketLayout<CylinderKind, float>;
template struct PacketLayout<CylinderKind, double>;

}  // namespace raytracer
