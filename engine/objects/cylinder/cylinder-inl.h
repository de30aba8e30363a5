// Packets against cylinders.

#include <cstdint>
#include <limits>

#include "engine/objects/cylinder/packets.h"
#include "engine/objects/geometry.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Cylinders, one for each lane's ray, or the same in all lanes.
template <class V>
struct Cylinders : AxialLanes<V> {
  V radius2;
};

template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE Cylinders<V> in_all_lanes(D d, const CylinderItem<T>& c) {
  return {{d, c}, hn::Set(d, c.radius2)};
}
template <typename T, class Get>
HWY_INLINE auto lanes_of(const CylinderBlock<T>& block, Get get) {
  return Cylinders<decltype(get(block.id))>{{block, get}, get(block.radius2)};
}

template <class D, class V>
HWY_INLINE V breadth(D d, const Cylinders<V>& c, const InAxes<V>&) {
  return hn::Sqrt(hn::Max(c.radius2, hn::Zero(d)));
}
template <class D, class V, typename T = hn::TFromD<D>>
HWY_INLINE V power_noise(D d, const Cylinders<V>& c, const InAxes<V>& f, const V3<V>& point) {
  return hn::Mul(hn::Set(d, 8 * std::numeric_limits<T>::epsilon()),
                 hn::Mul(rounded_reach(c, f, point), breadth(d, c, f)));
}
template <class V>
HWY_INLINE V power_of(const Cylinders<V>& c, const InAxes<V>& f) {
  return hn::Sub(hn::MulAdd(f.u, f.u, hn::Mul(f.v, f.v)), c.radius2);
}

/// Where rays are within the endless cylinder.
template <class V, class M>
struct CylinderCrossings {
  V enter;
  V leave;
  M are_there;
};

/// A direction along the axis is taken a little aslant: no quotient is then other than a number.
template <typename T>
inline constexpr T least_square = sizeof(T) == sizeof(float) ? T(1e-30) : T(1e-60);
template <typename T>
inline constexpr T least_slope = sizeof(T) == sizeof(float) ? T(1e-20) : T(1e-60);

/// `f` is from the foot to the rays' origins, `g` their directions, `power` |f|^2 - radius^2 across
/// the axis.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE CylinderCrossings<V, M> crossings_of(D d, const Cylinders<V>& c, const InAxes<V>& f,
                                                const InAxes<V>& g, V power) {
  const V zero = hn::Zero(d);
  const V a = hn::Max(hn::MulAdd(g.u, g.u, hn::Mul(g.v, g.v)), hn::Set(d, least_square<T>));
  const V b = hn::Sub(zero, hn::MulAdd(f.u, g.u, hn::Mul(f.v, g.v)));  // never -0
  const V x = hn::MulSub(f.u, g.v, hn::Mul(f.v, g.u));
  const V room = hn::NegMulAdd(x, x, hn::Mul(c.radius2, a));
  const V s = hn::Sqrt(hn::Max(room, zero));
  const V q = hn::Add(b, hn::CopySign(s, b));
  const V one = hn::Div(power, q);
  const V other = hn::Div(q, a);
  const M ahead = hn::Ge(b, zero);
  return {hn::IfThenElse(ahead, one, other), hn::IfThenElse(ahead, other, one), hn::Ge(room, zero)};
}

/// Where the way through the side and that between the ends overlap.
template <class D, class V, class M, typename T = hn::TFromD<D>>
HWY_INLINE AxialChord<V, M> closed_chord(D d, const Cylinders<V>& c, const InAxes<V>& f,
                                         const InAxes<V>& g,
                                         const CylinderCrossings<V, M>& crossings) {
  const V least = hn::Set(d, least_slope<T>);
  const V slope = hn::IfThenElse(hn::Lt(hn::Abs(g.w), least), hn::CopySign(least, g.w), g.w);
  const V to_low = hn::Div(hn::Sub(c.low, f.w), slope);
  const V to_high = hn::Div(hn::Sub(c.high, f.w), slope);
  const V enter_ends = hn::Min(to_low, to_high);
  const V enter = hn::Max(crossings.enter, enter_ends);
  const V leave = hn::Min(crossings.leave, hn::Max(to_low, to_high));
  return {hn::And(crossings.are_there, hn::Le(enter, leave)), enter, leave,
          hn::Gt(enter_ends, crossings.enter)};
}
template <class D, class V, class M>
HWY_INLINE SideHits<V, M> side_hits(D, const Cylinders<V>& c, const InAxes<V>& f,
                                    const InAxes<V>& g, const CylinderCrossings<V, M>& crossings) {
  const auto is_between = [&](V t) HWY_ATTR {
    const V along = hn::MulAdd(t, g.w, f.w);
    return hn::And(crossings.are_there, hn::And(hn::Ge(along, c.low), hn::Le(along, c.high)));
  };
  return {is_between(crossings.enter), is_between(crossings.leave), crossings.enter,
          crossings.leave};
}

/// From inside, to the other side: 2 b / a, where b is exact by the normal.
template <class D, class V, class M, typename T = hn::TFromD<D>>
HWY_INLINE M leave_side(D d, const Cylinders<V>& c, const RayOrigin<V>& from, const V3<V>&,
                        const InAxes<V>& f, const InAxes<V>& g, const CylinderCrossings<V, M>&,
                        V& t) {
  const V zero = hn::Zero(d);
  const InAxes<V> n = direction_along(c, from.normal);
  const M inwards = hn::Lt(hn::MulAdd(f.u, n.u, hn::Mul(f.v, n.v)), zero);
  const V a = hn::Max(hn::MulAdd(g.u, g.u, hn::Mul(g.v, g.v)), hn::Set(d, least_square<T>));
  const V slant = hn::MulAdd(n.u, g.u, hn::Mul(n.v, g.v));
  t = hn::Div(hn::Mul(hn::Add(slant, slant), breadth(d, c, f)), a);
  const V along = hn::MulAdd(t, g.w, f.w);
  const M is_beyond = hn::Or(hn::And(hn::Gt(g.w, zero), hn::Gt(along, c.high)),
                             hn::And(hn::Lt(g.w, zero), hn::Lt(along, c.low)));
  return hn::AndNot(is_beyond, hn::And(inwards, hn::Gt(t, zero)));
}

/// Rays from the eye against cylinder `index`, which the eye is not inside of.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void intersect_candidate(D d, const PrimitiveRows<T>&,
                                    const Geometry<CylinderKind, T>& cylinders, std::uint32_t index,
                                    const V3<V>& direction, Hit<V>& hit) {
  const CylinderItem<T>& item = cylinders.items[index];
  const Cylinders<V> c = in_all_lanes(d, item);
  const V zero = hn::Zero(d);
  const InAxes<V> g = direction_along(c, direction);
  if (!(item.eye_power > 0)) {  // within the endless cylinder
    V t;
    const M is_hit = meet_from_eye(d, c, item, g, t);
    return take(hit, is_nearer(hit, t, c.id, is_hit), t, c.id);
  }
  // The side is met from outside, if at all.
  const V a = hn::MulAdd(g.u, g.u, hn::Mul(g.v, g.v));
  const V b = hn::Mul(c.distance, g.v);
  const V x = hn::Mul(c.distance, g.u);
  const V room = hn::NegMulAdd(x, x, hn::Mul(c.radius2, a));
  const M crosses = hn::And(hn::Ge(room, zero), hn::Gt(b, zero));
  const V q = hn::Add(b, hn::Sqrt(hn::Max(room, zero)));
  V t = hn::Div(hn::Set(d, item.eye_power), q);
  const V along = hn::Mul(t, g.w);
  M is_hit = hn::And(crosses, hn::And(hn::Ge(along, c.low), hn::Le(along, c.high)));
  if (item.low > 0) {  // that end is seen
    const M before = hn::And(hn::Lt(along, c.low), hn::And(crosses, hn::Gt(g.w, zero)));
    if (item.has_caps > 0) {
      // The cap is passed before the ray leaves the endless cylinder: low / w <= q / a.
      const M on_cap = hn::And(before, hn::Le(hn::Mul(c.low, a), hn::Mul(q, g.w)));
      t = hn::IfThenElse(on_cap, hn::Div(c.low, g.w), t);
      is_hit = hn::Or(is_hit, on_cap);
    } else {
      const V far = hn::Div(q, a);
      const V far_along = hn::Mul(far, g.w);
      const M inside =
          hn::And(before, hn::And(hn::Ge(far_along, c.low), hn::Le(far_along, c.high)));
      t = hn::IfThenElse(inside, far, t);
      is_hit = hn::Or(is_hit, inside);
    }
  }
  take(hit, is_nearer(hit, t, c.id, is_hit), t, c.id);
}

/// Lanes from which a closed cylinder hides its distant light; the caller leaves out its own
/// points.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M hides_distant_light(D d, const CylinderShadow<T>& c, const V3<V>& point) {
  const V zero = hn::Zero(d);
  const V x = hn::Sub(dot(broadcast(d, c.k), point), hn::Set(d, c.x));
  const V b = hn::Sub(hn::Set(d, c.b), dot(broadcast(d, c.e), point));
  const V along = hn::Sub(dot(broadcast(d, c.w), point), hn::Set(d, c.along));
  const V room = hn::NegMulAdd(x, x, hn::Set(d, c.radius2));
  const V s = hn::Sqrt(hn::Max(room, zero));
  const V per_e = hn::Set(d, c.per_e);
  const V per_w = hn::Set(d, c.per_w);
  const V to_low = hn::Mul(hn::Sub(hn::Set(d, c.low), along), per_w);
  const V to_high = hn::Mul(hn::Sub(hn::Set(d, c.high), along), per_w);
  const V enter = hn::Max(hn::Mul(hn::Sub(b, s), per_e), hn::Min(to_low, to_high));
  const V leave = hn::Min(hn::Mul(hn::Add(b, s), per_e), hn::Max(to_low, to_high));
  return hn::And(hn::Ge(room, zero),
                 hn::And(hn::Le(enter, leave), hn::Gt(hn::Add(enter, leave), zero)));
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
