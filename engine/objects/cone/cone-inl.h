// Packets against cones. The names are those of cone.h.

#include <limits>

#include "engine/objects/cone/packets.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Cones, one for each lane's ray, or the same in all lanes.
template <class V>
struct Cones : AxialLanes<V> {
  V sine;
  V girth;
  V low_girth2;
  V high_girth2;
};

template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE Cones<V> in_all_lanes(D d, const ConeItem<T>& c) {
  return {{d, c},
          hn::Set(d, c.sine),
          hn::Set(d, c.girth),
          hn::Set(d, c.low_girth2),
          hn::Set(d, c.high_girth2)};
}
template <typename T, class Get>
HWY_INLINE auto lanes_of(const ConeBlock<T>& block, Get get) {
  return Cones<decltype(get(block.id))>{{block, get},
                                        get(block.sine),
                                        get(block.girth),
                                        get(block.low_girth2),
                                        get(block.high_girth2)};
}

/// A place or a direction as cones see it: across the axis in cosines, and the girth there or what
/// it grows by.
template <class V>
struct AlongCone : InAxes<V> {
  V girth;
};
template <class V>
HWY_INLINE AlongCone<V> direction_along(const Cones<V>& c, const V3<V>& a) {
  const V w = dot(c.axis, a);
  return {{dot(c.across, a), dot(c.towards, a), w}, hn::Mul(c.sine, w)};
}
template <class V>
HWY_INLINE AlongCone<V> place_along(const Cones<V>& c, const V3<V>& a) {
  const V w = dot(c.axis, a);
  return {{dot(c.across, a), hn::Sub(dot(c.towards, a), c.distance), w},
          hn::MulAdd(c.sine, w, c.girth)};
}
template <class D, class V>
HWY_INLINE AlongCone<V> eye_along(D d, const Cones<V>& c) {
  const V zero = hn::Zero(d);
  return {{zero, hn::Neg(c.distance), zero}, c.girth};
}

/// The girth is found along the axis, which is in no cosines: of a flat cone that is what counts.
template <class V>
HWY_INLINE V rounded_reach(const Cones<V>& c, const AlongCone<V>& f, const V3<V>& point) {
  const V size = hn::Add(hn::Abs(point.x), hn::Add(hn::Abs(point.y), hn::Abs(point.z)));
  const V across = hn::Add(hn::Add(hn::Abs(f.u), hn::Abs(f.v)), c.distance);
  return hn::Add(hn::Add(across, hn::Abs(f.girth)), size);
}
/// What is across the axis is in cosines of both.
template <class V>
HWY_INLINE V outwards(const Cones<V>& c, const InAxes<V>& f, const AlongCone<V>& n) {
  const V along = hn::Mul(dot(c.across, c.across), hn::Mul(f.w, n.w));
  return hn::MulAdd(f.u, n.u, hn::MulAdd(f.v, n.v, along));
}
template <class D, class V>
HWY_INLINE V breadth(D, const Cones<V>&, const AlongCone<V>& f) {
  return hn::Sqrt(hn::MulAdd(f.u, f.u, hn::Mul(f.v, f.v)));
}
template <class D, class V, typename T = hn::TFromD<D>>
HWY_INLINE V power_noise(D d, const Cones<V>& c, const AlongCone<V>& f, const V3<V>& point) {
  const V girths = hn::Add(breadth(d, c, f), hn::Abs(f.girth));
  return hn::Mul(hn::Set(d, 8 * std::numeric_limits<T>::epsilon()),
                 hn::Mul(rounded_reach(c, f, point), girths));
}
template <class V>
HWY_INLINE V power_of(const Cones<V>&, const AlongCone<V>& f) {
  return hn::NegMulAdd(f.girth, f.girth, hn::MulAdd(f.u, f.u, hn::Mul(f.v, f.v)));
}

/// Where rays are within closed cones.
template <class V, class M>
struct ConeChords {
  M is_there;
  V enter;
  V leave;
  M enters_disc;  ///< through the disc of an end, not through the side
  M leaves_disc;
  V a;  ///< as in cone.h
};

// No quotient is other than a number: what divides is at least this.
template <typename T>
inline constexpr T least_divisor = sizeof(T) == sizeof(float) ? T(1e-20) : T(1e-60);
template <typename T>
inline constexpr T least_root = sizeof(T) == sizeof(float) ? T(1e-30) : T(1e-150);

/// `x` or, where that is less, a tiny number of its sign.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V at_least(D d, V x, T least) {
  return hn::CopySign(hn::Max(hn::Abs(x), hn::Set(d, least)), x);
}

/// `f` are the rays' origins, `g` their directions, `power` is C.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE ConeChords<V, M> crossings_of(D d, const Cones<V>& c, const AlongCone<V>& f,
                                         const AlongCone<V>& g, V power) {
  const V zero = hn::Zero(d);
  const V a = hn::NegMulAdd(g.girth, g.girth, hn::MulAdd(g.u, g.u, hn::Mul(g.v, g.v)));
  const V along = hn::MulAdd(f.u, g.u, hn::Mul(f.v, g.v));
  const V b = hn::Sub(zero, hn::NegMulAdd(f.girth, g.girth, along));  // never -0
  const V x = hn::MulSub(f.u, g.v, hn::Mul(f.v, g.u));
  const V p_u = hn::MulSub(f.girth, g.u, hn::Mul(g.girth, f.u));
  const V p_v = hn::MulSub(f.girth, g.v, hn::Mul(g.girth, f.v));
  const V room = hn::NegMulAdd(x, x, hn::MulAdd(p_u, p_u, hn::Mul(p_v, p_v)));
  const V s = hn::Max(hn::Sqrt(hn::Max(room, zero)), hn::Set(d, least_root<T>));
  const V q = hn::Add(b, hn::CopySign(s, b));
  const V one = hn::Div(power, q);
  const V other = hn::Div(q, at_least(d, a, least_divisor<T>));
  const M ahead = hn::Ge(b, zero);

  const V slope = at_least(d, g.w, least_divisor<T>);
  const M is_up = hn::Gt(slope, zero);
  const V to_low = hn::Div(hn::Sub(c.low, f.w), slope);
  const V to_high = hn::Div(hn::Sub(c.high, f.w), slope);
  const V t_in = hn::Min(to_low, to_high);
  const V t_out = hn::Max(to_low, to_high);
  const auto is_in_disc = [&](V t, V girth2) HWY_ATTR {
    const V u = hn::MulAdd(t, g.u, f.u);
    const V v = hn::MulAdd(t, g.v, f.v);
    return hn::Lt(hn::MulAdd(u, u, hn::Mul(v, v)), girth2);  // a tip is none
  };
  const M in = is_in_disc(t_in, hn::IfThenElse(is_up, c.low_girth2, c.high_girth2));
  const M out = is_in_disc(t_out, hn::IfThenElse(is_up, c.high_girth2, c.low_girth2));
  const M within_side = hn::And(hn::And(hn::Gt(a, zero), hn::Ge(room, zero)),
                                hn::And(hn::Gt(b, hn::Mul(a, t_in)), hn::Lt(b, hn::Mul(a, t_out))));
  const auto between = [&](V t) HWY_ATTR { return hn::Min(hn::Max(t, t_in), t_out); };
  return {hn::Or(within_side, hn::Or(in, out)),
          hn::IfThenElse(in, t_in, between(hn::IfThenElse(ahead, one, other))),
          hn::IfThenElse(out, t_out, between(hn::IfThenElse(ahead, other, one))),
          in,
          out,
          a};
}

template <class D, class V, class M>
HWY_INLINE AxialChord<V, M> closed_chord(D, const Cones<V>&, const AlongCone<V>&,
                                         const AlongCone<V>&, const ConeChords<V, M>& chords) {
  return {chords.is_there, chords.enter, chords.leave, chords.enters_disc};
}
template <class D, class V, class M>
HWY_INLINE SideHits<V, M> side_hits(D, const Cones<V>&, const AlongCone<V>&, const AlongCone<V>&,
                                    const ConeChords<V, M>& chords) {
  return {hn::AndNot(chords.enters_disc, chords.is_there),
          hn::AndNot(chords.leaves_disc, chords.is_there), chords.enter, chords.leave};
}

/// From inside, to the other side: 2 b / a, where b is exact by the normal.
template <class D, class V, class M, typename T = hn::TFromD<D>>
HWY_INLINE M leave_side(D d, const Cones<V>& c, const RayOrigin<V>& from, const V3<V>& direction,
                        const AlongCone<V>& f, const AlongCone<V>& g,
                        const ConeChords<V, M>& chords, V& t) {
  const V zero = hn::Zero(d);
  const V girth = breadth(d, c, f);
  const AlongCone<V> n = direction_along(c, from.normal);
  const V outward = hn::NegMulAdd(n.girth, girth, hn::MulAdd(f.u, n.u, hn::Mul(f.v, n.v)));
  const V b = hn::Mul(girth, dot(from.normal, direction));
  t = hn::Div(hn::Add(b, b), at_least(d, chords.a, least_divisor<T>));
  const V slope = at_least(d, g.w, least_divisor<T>);
  const V end = hn::IfThenElse(hn::Gt(slope, zero), c.high, c.low);
  const M between = hn::And(hn::Gt(t, zero), hn::Le(t, hn::Div(hn::Sub(end, f.w), slope)));
  return hn::And(hn::Lt(outward, zero), between);
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
