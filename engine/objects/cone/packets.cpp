// How cones lie in memory, and what the eye knows of them beforehand.
#include "engine/objects/cone/packets.h"

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

template <typename T>
ConeItem<T> PacketLayout<ConeKind, T>::item(const PackedCone& c, std::int32_t number) {
  const AxisBasis own(c);
  const auto girth2 = [&](bool is_to) {
    const double girth = c.cosine * c.radius(is_to);
    return static_cast<T>(girth * girth);
  };
  return {AxialItem<T>::of(c, own, number, c.cosine),
          static_cast<T>(own.is_turned ? -c.sine : c.sine), static_cast<T>(c.girth_at_foot),
          girth2(own.is_turned), girth2(!own.is_turned)};
}

template struct PacketLayout<ConeKind, float>;
template struct PacketLayout<ConeKind, double>;

}  // namespace raytracer
