// A packet against one sphere after another.

#if defined(RAYTRACER_KERNEL_SIMD_SPHERE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_SPHERE_INL_H_
#undef RAYTRACER_KERNEL_SIMD_SPHERE_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_SPHERE_INL_H_
#endif

#include <cstdint>

#include "engine/kernel/simd/hit-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// Rays from the eye against the spheres of what they go through: near to far, until the next one
/// is farther than all that is seen already.
template <class D, class Contents, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE void show_spheres_to_eye(D d, const SimdScene<T>& scene, const Contents& contents,
                                    const V3<V>& direction, M active, Nearest<V>& nearest) {
  const V zero = hn::Zero(d);
  const auto sees = [&](float distance)
                        HWY_ATTR { return sees_as_far_as(d, distance, nearest, active); };
  using Table = PrimitiveTable<T>;
  contents.for_each_sphere(sees, [&](std::uint32_t primitive) HWY_ATTR {
    const T* const row = scene.primitives.row(primitive);
    const V3<V> center{hn::Set(d, row[Table::x]), hn::Set(d, row[Table::y]),
                       hn::Set(d, row[Table::z])};
    const V b = dot(center, direction);
    const V3<V> l{hn::MulSub(direction.x, b, center.x), hn::MulSub(direction.y, b, center.y),
                  hn::MulSub(direction.z, b, center.z)};
    const V discriminant = hn::Sub(hn::Set(d, row[Table::radius2]), dot(l, l));
    const M hit = hn::And(hn::Ge(discriminant, zero), hn::Gt(b, zero));
    // Also where no lane hits: a wrong guess of the processor, which of small spheres there would
    // be many, costs more than a division.
    const V t =
        hn::Div(hn::Set(d, row[Table::eye_c]), hn::Add(b, hn::Sqrt(hn::Max(discriminant, zero))));
    const V id = hn::Set(d, static_cast<T>(primitive));
    take(nearest, is_nearer(nearest, t, id, hit), t, id);
  });
}

/// Spheres, one for each lane's ray.
template <class V>
struct Spheres {
  V3<V> center;
  V radius2;
  V id;
};

/// What distances to spheres, from anywhere outside of them, follow from; lanes that leave a sphere
/// do not meet it.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE M meets_sphere(D d, const Spheres<V>& spheres, const Start<V>& from,
                          const V3<V>& direction, V& b, V& discriminant, V& c) {
  const V zero = hn::Zero(d);
  const V3<V> f = sub(from.point, spheres.center);
  b = hn::Neg(dot(f, direction));
  const V3<V> l = mul_add(direction, b, f);
  discriminant = hn::Sub(spheres.radius2, dot(l, l));
  c = hn::Max(hn::Sub(dot(f, f), spheres.radius2), zero);
  const M other = hn::Ne(from.id, spheres.id);
  return hn::And(other, hn::And(hn::Ge(discriminant, zero), hn::Gt(b, zero)));
}

/// The same for one sphere.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M meets_sphere(D d, const SimdSphere<T>& sphere, const Start<V>& from,
                          const V3<V>& direction, V& b, V& discriminant, V& c) {
  const Spheres<V> spheres{broadcast(d, sphere.center), hn::Set(d, sphere.radius2),
                           hn::Set(d, sphere.id)};
  return meets_sphere(d, spheres, from, direction, b, discriminant, c);
}

/// The packet against one sphere.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void show_sphere(D d, const SimdSphere<T>& sphere, const Start<V>& from,
                            const V3<V>& direction, M active, Nearest<V>& nearest) {
  V b;
  V discriminant;
  V c;
  const M hit = hn::And(active, meets_sphere(d, sphere, from, direction, b, discriminant, c));
  if (hn::AllFalse(d, hit)) return;
  const V t = hn::Div(c, hn::Add(b, hn::Sqrt(hn::Max(discriminant, hn::Zero(d)))));
  const V id = hn::Set(d, sphere.id);
  take(nearest, is_nearer(nearest, t, id, hit), t, id);
}

/// Lanes whose ray to a point light meets a LitSphere before it. Lanes hold points, spheres or
/// both. `towards` is a unit vector to the light, `path` the point's distance from it. No point is
/// inside a sphere.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE M stands_before_light(D d, const V3<V>& center, V radius2, V nearest,
                                 const V3<V>& towards, V path) {
  const V zero = hn::Zero(d);
  const V b = hn::Neg(dot(center, towards));
  const V3<V> l = mul_add(towards, b, center);
  const M is_ahead = hn::Or(hn::Gt(b, zero), hn::Lt(nearest, zero));
  return hn::And(hn::And(is_ahead, hn::Lt(b, path)), hn::Ge(radius2, dot(l, l)));
}

/// The same before a far light: as the points see it.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE M stands_before_far_light(D d, const V3<V>& center, V radius2, const V3<V>& point,
                                     const V3<V>& towards, V path) {
  const V3<V> f = sub(center, point);
  const V b = dot(f, towards);
  const V3<V> l = mul_add(towards, hn::Neg(b), f);
  const M is_between = hn::And(hn::Gt(b, hn::Zero(d)), hn::Lt(b, path));
  return hn::And(is_between, hn::Ge(radius2, dot(l, l)));
}

/// Lanes of `lit` from which the sphere stands before its point light, `path` away.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_by(D d, const LightBall<T>& ball, bool is_far, const Start<V>& from,
                         const V3<V>& towards, V path, M lit) {
  const V3<V> center = broadcast(d, ball.center);
  const V radius2 = hn::Set(d, ball.radius2);
  const M meets =
      is_far ? stands_before_far_light(d, center, radius2, from.point, towards, path)
             : stands_before_light(d, center, radius2, hn::Set(d, ball.nearest), towards, path);
  return hn::And(hn::And(lit, meets), hn::Ne(from.id, hn::Set(d, ball.id)));
}

/// Lanes of `lit` from which the sphere stands before a distant light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_by(D d, const SimdSphere<T>& sphere, const Start<V>& from,
                         const V3<V>& towards, M lit) {
  V b;
  V discriminant;
  V c;
  return hn::And(lit, meets_sphere(d, sphere, from, towards, b, discriminant, c));
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
