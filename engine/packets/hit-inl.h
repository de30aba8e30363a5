// Where a packet begins and what it has hit.

#include <limits>

#include "engine/math/tolerances.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Where the lanes of a packet begin, and which surface they leave (-1: none).
template <class V>
struct RayOrigin {
  V3<V> point;
  V3<V> normal;  ///< of the surface that is left
  V id;          ///< numbers of primitives are kept as T: they are small
  V u;           ///< the place on the primitive, as its kind counts
  V v;
};

/// Rays that may begin inside of solids, to which these then have a way out.
template <class V>
struct InnerOrigin : RayOrigin<V> {};

template <class Origin>
inline constexpr bool may_be_inside = false;
template <class V>
inline constexpr bool may_be_inside<InnerOrigin<V>> = true;

/// The nearest primitive so far. `id` -1: none.
template <class V>
struct Hit {
  V t;
  V id;
  V u;  ///< the place on the primitive, as its kind counts
  V v;
  V3<V> normal;  ///< there, of kinds that compute it when they are met

  /// Every member from a vector: g++ clears zeros by a string instruction, which is slow.
  HWY_INLINE Hit(V distance, V primitive, V no_u, V no_v)
      : t(distance), id(primitive), u(no_u), v(no_v), normal{no_u, no_u, no_u} {}
};

/// Makes `id` at t the nearest hit of the lanes `nearer`.
template <class V, class M>
HWY_INLINE void take(Hit<V>& hit, M nearer, V t, V id) {
  hit.t = hn::IfThenElse(nearer, t, hit.t);
  hit.id = hn::IfThenElse(nearer, id, hit.id);
}

/// Whether a hit at t of primitive `id` counts: nearer, or as near and earlier in the document.
template <class V, class M>
HWY_INLINE M is_nearer(V nearest_t, V nearest_id, V t, V id, M is_hit) {
  const M sooner = hn::Lt(t, nearest_t);
  const M first_of_equals = hn::And(hn::Eq(t, nearest_t), hn::Lt(id, nearest_id));
  return hn::And(is_hit, hn::Or(sooner, first_of_equals));
}
template <class V, class M>
HWY_INLINE M is_nearer(const Hit<V>& hit, V t, V id, M is_hit) {
  return is_nearer(hit.t, hit.id, t, id, is_hit);
}

/// Where rays are within convex solids, one for each lane: where they come in and where out, of
/// which those that are rounding alone are less than `noise`. What begins on an end, though of
/// something else, has come in there.
template <class V, class M>
struct Chords {
  M is_there;
  V enter;
  V leave;
  V noise;
  M enters_end;
};

/// Lanes that begin inside of their solids: on the surface of which they leave it inwards,
/// `outward` being positive where a ray leaves it outwards; others by more than rounding.
template <class D, class V, class M>
HWY_INLINE M begins_inside(D d, const Chords<V, M>& chords, M is_left, V outward) {
  const V latest = hn::IfThenElse(chords.enters_end, chords.noise, hn::Neg(chords.noise));
  const M amid = hn::And(hn::Lt(chords.enter, latest), hn::Gt(chords.leave, chords.noise));
  return hn::Or(hn::AndNot(is_left, amid), hn::And(is_left, hn::Lt(outward, hn::Zero(d))));
}

/// Lanes that meet their solids from outside or inside, and where. `id` is the solid's; `outward`
/// as above.
template <class D, class V, class M>
HWY_INLINE M meet_solid(D d, const Chords<V, M>& chords, const InnerOrigin<V>& from, V id,
                        V outward, V& t) {
  const V zero = hn::Zero(d);
  const M is_left = hn::Eq(from.id, id);
  const M inside = begins_inside(d, chords, is_left, outward);
  const M outside = hn::AndNot(is_left, hn::Gt(hn::Add(chords.enter, chords.leave), zero));
  t = hn::Max(hn::IfThenElse(inside, chords.leave, chords.enter), zero);
  return hn::And(chords.is_there, hn::Or(inside, outside));
}

/// How far rays' places are rounded by, a few times over, on solids of that size.
template <class D, class V, typename T = hn::TFromD<D>>
HWY_INLINE V place_noise(D d, const V3<V>& point, V size) {
  const V reach = hn::Add(hn::Add(hn::Abs(point.x), hn::Abs(point.y)), hn::Abs(point.z));
  return hn::Mul(hn::Set(d, 64 * std::numeric_limits<T>::epsilon()), hn::Add(reach, size));
}

/// Whether a lane of `active` sees nothing yet that is nearer than `distance`.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE bool sees_as_far_as(D d, float distance, const Hit<V>& hit, M active) {
  const V distances = hn::Set(d, static_cast<T>(distance));
  return !hn::AllFalse(d, hn::And(active, hn::Ge(hit.t, distances)));
}

/// Rays from surface points to a light.
template <class V>
struct ShadowRays {
  const RayOrigin<V>& from;
  V3<V> towards;  ///< unit
  V path;         ///< the light's distance; the largest number if that is infinite
  V incidence;    ///< normal . towards
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
