// A packet against a plane or a triangle.

#if defined(RAYTRACER_KERNEL_SIMD_FLAT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_FLAT_INL_H_
#undef RAYTRACER_KERNEL_SIMD_FLAT_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_FLAT_INL_H_
#endif

#include <limits>

#include "engine/kernel/simd/hit-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// How far from a plane a point may be for its distance to be rounding alone.
template <typename T>
inline constexpr T plane_noise = 16 * std::numeric_limits<T>::epsilon();

/// Distances to planes at `height` along their normals; the ray that leaves one does not meet it.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M meets_plane(D d, const V3<V>& normal, V height, V id, const Start<V>& from,
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
HWY_INLINE M meets_plane(D d, const SimdPlane<T>& plane, const Start<V>& from,
                         const V3<V>& direction, V& t) {
  return meets_plane(d, broadcast(d, plane.normal), hn::Set(d, plane.height),
                     hn::Set(d, static_cast<T>(plane.id)), from, direction, t);
}

/// Lanes whose point is on the other side of the plane than a point light, however far they are
/// from each other. A light in the plane, of side 0, is not hidden.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M stands_between(D d, const SimdPlane<T>& plane, const Start<V>& from, T light_side) {
  const V height = hn::Set(d, plane.height);
  const V along = dot(broadcast(d, plane.normal), from.point);
  const V noise = hn::Mul(hn::Set(d, plane_noise<T>), hn::Add(hn::Abs(height), hn::Abs(along)));
  const V towards_light = hn::Mul(hn::Set(d, light_side), hn::Sub(along, height));
  return hn::And(hn::Lt(towards_light, hn::Neg(noise)),
                 hn::Ne(from.id, hn::Set(d, static_cast<T>(plane.id))));
}

/// The lanes' planes across their rays (see across() in engine/math/vec.h).
template <class V>
struct AcrossPacket {
  V3<V> u;
  V3<V> v;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE AcrossPacket<V> across_packet(D d, const V3<V>& w) {
  const V one = hn::Set(d, hn::TFromD<D>(1));
  const V sign = hn::CopySign(one, w.z);
  const V a = hn::Neg(hn::Div(one, hn::Add(sign, w.z)));
  const V b = hn::Mul(hn::Mul(w.x, w.y), a);
  return {{hn::MulAdd(hn::Mul(sign, w.x), hn::Mul(w.x, a), one), hn::Mul(sign, b),
           hn::Neg(hn::Mul(sign, w.x))},
          {b, hn::MulAdd(hn::Mul(w.y, w.y), a, sign), hn::Neg(w.y)}};
}

/// Triangles, one for each lane's ray.
template <class V>
struct Triangles {
  V3<V> a;
  V3<V> b;
  V3<V> c;
  V3<V> normal;
  V height;
  V id;
};

/// Lanes whose rays pass through their triangle, as intersect_triangle() in engine/kernel/flat.h
/// decides it. The products are not fused: that could make their difference's sign wrong.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE M passes_through(D d, const Triangles<V>& triangles, const V3<V>& origin,
                            const AcrossPacket<V>& plane) {
  const V3<V> a = sub(triangles.a, origin);
  const V3<V> b = sub(triangles.b, origin);
  const V3<V> c = sub(triangles.c, origin);
  const V a_u = dot(plane.u, a);
  const V a_v = dot(plane.v, a);
  const V b_u = dot(plane.u, b);
  const V b_v = dot(plane.v, b);
  const V c_u = dot(plane.u, c);
  const V c_v = dot(plane.v, c);
  const V ab = hn::Sub(hn::Mul(a_u, b_v), hn::Mul(a_v, b_u));
  const V bc = hn::Sub(hn::Mul(b_u, c_v), hn::Mul(b_v, c_u));
  const V ca = hn::Sub(hn::Mul(c_u, a_v), hn::Mul(c_v, a_u));
  const V least = hn::Min(hn::Min(ab, bc), ca);
  const V most = hn::Max(hn::Max(ab, bc), ca);
  const V zero = hn::Zero(d);
  return hn::Or(hn::Ge(least, zero), hn::Le(most, zero));
}

/// Lanes whose triangle does not lie wholly on or under the tangent plane that the ray leaves. What
/// does cannot be met by it: that settles the triangle itself and its coplanar neighbours by their
/// exact corners, not by the rounded point.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M rises_above(D d, const Triangles<V>& triangles, const Start<V>& from) {
  const V reach =
      hn::Add(hn::Max(hn::Abs(from.point.x), hn::Abs(from.point.y)), hn::Abs(from.point.z));
  M above = hn::Lt(from.id, hn::Zero(d));  // nothing is under the eye
  for (const V3<V>* corner : {&triangles.a, &triangles.b, &triangles.c}) {
    const V size = hn::Add(hn::Add(hn::Abs(corner->x), hn::Abs(corner->y)), hn::Abs(corner->z));
    const V noise = hn::Mul(hn::Set(d, plane_noise<T>), hn::Add(size, reach));
    above = hn::Or(above, hn::Gt(dot(from.normal, sub(*corner, from.point)), noise));
  }
  return above;
}

/// Distances to triangles.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE M meets(D d, const Triangles<V>& triangles, const Start<V>& from, const V3<V>& direction,
                   const AcrossPacket<V>& plane, M active, V& t) {
  M hit = hn::And(active, passes_through(d, triangles, from.point, plane));
  t = hn::Zero(d);
  if (hn::AllFalse(d, hit)) return hit;
  hit = hn::And(
      hit, meets_plane(d, triangles.normal, triangles.height, triangles.id, from, direction, t));
  return hn::And(hit, rises_above(d, triangles, from));
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
