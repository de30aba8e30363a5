// Packets against planes.

#include "engine/lights/packet_light.h"
#include "engine/math/tolerances.h"
#include "engine/objects/geometry.h"
#include "engine/objects/plane/packets.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Directions that are not along the plane, but for what rounding makes of them and of its normal.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M goes_across(D d, const V3<V>& normal, const V3<V>& direction) {
  const V parts = hn::MulAdd(hn::Abs(normal.x), hn::Abs(direction.x),
                             hn::MulAdd(hn::Abs(normal.y), hn::Abs(direction.y),
                                        hn::Mul(hn::Abs(normal.z), hn::Abs(direction.z))));
  const V noise = hn::Mul(parts, hn::Set(d, sine_noise<T>));
  return hn::Gt(hn::Abs(dot(normal, direction)), noise);
}

/// A plane has no end that a ray along it would miss.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M meets(D d, const FlatItem<T>& plane, const RayOrigin<V>& from, const V3<V>& direction,
                   V& t) {
  return hn::And(goes_across(d, broadcast(d, plane.normal), direction),
                 intersect_plane(d, plane, from, direction, t));
}

/// The packet against one plane.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void intersect_item(D d, const Geometry<PlaneKind, T>&, const FlatItem<T>& plane,
                               const RayOrigin<V>& from, const V3<V>& direction, M active,
                               Hit<V>& hit) {
  V t;
  const M is_hit = hn::And(active, meets(d, plane, from, direction, t));
  const V id = hn::Set(d, plane.id);
  take(hit, is_nearer(hit, t, id, is_hit), t, id);
}

/// Lanes whose point is on the other side of the plane than a point light, however far they are
/// from each other. A light in the plane, of side 0, is not hidden.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M stands_between(D d, const FlatItem<T>& plane, const RayOrigin<V>& from, T light_side) {
  const V height = hn::Set(d, plane.height);
  const V along = dot(broadcast(d, plane.normal), from.point);
  const V noise = hn::Mul(hn::Set(d, plane_noise<T>), hn::Add(hn::Abs(height), hn::Abs(along)));
  const V towards_light = hn::Mul(hn::Set(d, light_side), hn::Sub(along, height));
  return hn::And(hn::Lt(towards_light, hn::Neg(noise)), hn::Ne(from.id, hn::Set(d, plane.id)));
}

/// Lanes of `lit` from which a plane hides the light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_by(D d, const Geometry<PlaneKind, T>& planes, const PacketLight<T>& light,
                         const ShadowRays<V>& rays, M lit) {
  M dark = hn::Lt(hn::Zero(d), hn::Zero(d));
  for (std::size_t i = 0; i < planes.items.size(); ++i) {
    V t;
    const M hides =
        light.rays == LightRays::parallel
            ? meets(d, planes.items[i], rays.from, rays.towards, t)
            : stands_between(d, planes.items[i], rays.from, planes.lights[light.index].sides[i]);
    dark = hn::Or(dark, hn::And(lit, hides));
  }
  return dark;
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
