// Points of spheres that are known to be seen: the one that each lane shows.

#if defined(RAYTRACER_KERNEL_SIMD_SHOWN_SPHERE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_SHOWN_SPHERE_INL_H_
#undef RAYTRACER_KERNEL_SIMD_SHOWN_SPHERE_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_SHOWN_SPHERE_INL_H_
#endif

#include <cstddef>

#include "engine/kernel/simd/hit-inl.h"
#include "engine/kernel/simd/part_spheres-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// Spheres, one for each lane.
template <class D>
struct ShownSpheres {
  using T = hn::TFromD<D>;
  using V = hn::Vec<D>;

  V3<V> center;
  V radius2;
  V curvature;
  V id;
  V first;
  V second;
  V material;

  /// Those of a part with these places.
  HWY_INLINE ShownSpheres(D d, const PartSpheres<T>& spheres, V places) {
    using S = PartSpheres<T>;
    const auto index = hn::ConvertTo(hn::RebindToSigned<D>(), places);
    // Of few they are all in a register.
    const bool are_few = spheres.count <= hn::MaxLanes(d);
    const auto value = [&](typename S::Value which) HWY_ATTR {
      const T* const values = spheres.values[which];
      if (are_few) return hn::TableLookupLanes(hn::Load(d, values), hn::IndicesFromVec(d, index));
      return hn::GatherIndex(d, values, index);
    };
    center = {value(S::x), value(S::y), value(S::z)};
    radius2 = value(S::radius2);
    curvature = value(S::curvature);
    id = value(S::id);
    first = value(S::first);
    second = value(S::second);
    material = value(S::material);
  }

  /// Where a ray from the eye meets its lane's sphere, or nearly does.
  struct Sight {
    V3<V> direction;
    Start<V> at;
  };

  /// `through` is any point of the ray.
  HWY_INLINE Sight look(D d, const V3<V>& through) const {
    const V3<V> direction = unit(d, through);
    const V b = dot(center, direction);
    const V3<V> l{hn::MulSub(direction.x, b, center.x), hn::MulSub(direction.y, b, center.y),
                  hn::MulSub(direction.z, b, center.z)};
    const V root = hn::Sqrt(hn::Max(hn::Sub(radius2, dot(l, l)), hn::Zero(d)));
    const V3<V> normal = scale(mul_add(direction, hn::Neg(root), l), curvature);
    const V3<V> point = mul_add(normal, hn::Mul(radius2, curvature), center);
    return {direction, {point, normal, id, first, second}};
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
