// Where a packet starts and what it has met.

#if defined(RAYTRACER_KERNEL_SIMD_HIT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_HIT_INL_H_
#undef RAYTRACER_KERNEL_SIMD_HIT_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_HIT_INL_H_
#endif

#include "engine/kernel/simd/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// Where the lanes of a packet start, and which surface they leave (-1: none).
/// For a sphere of a square also its cell.
template <class V>
struct Start {
  V3<V> point;
  V3<V> normal;  ///< of the surface that is left
  V id;          ///< numbers of primitives are kept as T: they are small
  V first;
  V second;
};

/// The nearest primitive so far. `id` -1: none.
template <class V>
struct Nearest {
  V t;
  V id;
  V first;  ///< a square's cell
  V second;
  V3<V> normal;  ///< there

  /// Nothing is set to zero that g++ would clear by a string instruction.
  HWY_INLINE Nearest(V distance, V primitive, V no_first, V no_second)
      : t(distance),
        id(primitive),
        first(no_first),
        second(no_second),
        normal{no_first, no_first, no_first} {}
};

template <class V, class M>
HWY_INLINE void take(Nearest<V>& nearest, M nearer, V t, V id) {
  nearest.t = hn::IfThenElse(nearer, t, nearest.t);
  nearest.id = hn::IfThenElse(nearer, id, nearest.id);
}

/// Whether a hit at t of primitive `id` counts: nearer, or as near and earlier in the document.
template <class V, class M>
HWY_INLINE M is_nearer(V nearest_t, V nearest_id, V t, V id, M hit) {
  const M sooner = hn::Lt(t, nearest_t);
  const M first_of_equals = hn::And(hn::Eq(t, nearest_t), hn::Lt(id, nearest_id));
  return hn::And(hit, hn::Or(sooner, first_of_equals));
}
template <class V, class M>
HWY_INLINE M is_nearer(const Nearest<V>& nearest, V t, V id, M hit) {
  return is_nearer(nearest.t, nearest.id, t, id, hit);
}

/// Whether a lane of `active` sees nothing yet that is nearer than `distance`.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE bool sees_as_far_as(D d, float distance, const Nearest<V>& nearest, M active) {
  const V distances = hn::Set(d, static_cast<T>(distance));
  return !hn::AllFalse(d, hn::And(active, hn::Ge(nearest.t, distances)));
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
