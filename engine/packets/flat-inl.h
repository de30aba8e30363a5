// A packet against the plane of something flat: a plane or a triangle.

#include <limits>

#include "engine/packets/flat_layout.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// How far from a plane a point may be for its distance to be rounding alone.
template <typename T>
inline constexpr T plane_noise = 16 * std::numeric_limits<T>::epsilon();

/// Distances to planes at `height` along their normals; the ray that leaves one does not meet it.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M intersect_plane(D d, const V3<V>& normal, V height, V id, const RayOrigin<V>& from,
                             const V3<V>& direction, V& t) {
  const V rest = hn::Sub(height, dot(normal, from.point));
  const V noise =
      hn::Mul(hn::Set(d, plane_noise<T>), hn::Add(hn::Abs(height), hn::Abs(hn::Sub(height, rest))));
  t = hn::Div(rest, dot(normal, direction));
  const M other = hn::Ne(from.id, id);
  const M apart = hn::Gt(hn::Abs(rest), noise);
  const M ahead =
      hn::And(hn::Gt(t, hn::Zero(d)), hn::Lt(t, hn::Set(d, std::numeric_limits<T>::max())));
  return hn::And(hn::And(other, apart), ahead);
}

template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M intersect_plane(D d, const FlatItem<T>& plane, const RayOrigin<V>& from,
                             const V3<V>& direction, V& t) {
  return intersect_plane(d, broadcast(d, plane.normal), hn::Set(d, plane.height),
                         hn::Set(d, plane.id), from, direction, t);
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
