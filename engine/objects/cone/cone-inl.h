// Packets against cones. The names are those of cone.h.

#include <hwy/cache_control.h>

#include <cstddef>
#include <cstdint>
#include <limits>

#include "engine/lights/packet_light.h"
#include "engine/objects/cone/packets.h"
#include "engine/objects/geometry.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Cones, one for each lane's ray, or the same in all lanes.
template <class V>
struct Cones {
  V3<V> across;
  V3<V> towards;
  V3<V> axis;
  V distance;
  V sine;
  V girth;
  V low;
  V high;
  V low_girth2;
  V high_girth2;
  V has_caps;
  V id;
};

template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE Cones<V> in_all_lanes(D d, const ConeItem<T>& c) {
  return {broadcast(d, c.across),    broadcast(d, c.towards), broadcast(d, c.axis),
          hn::Set(d, c.distance),    hn::Set(d, c.sine),      hn::Set(d, c.girth),
          hn::Set(d, c.low),         hn::Set(d, c.high),      hn::Set(d, c.low_girth2),
          hn::Set(d, c.high_girth2), hn::Set(d, c.has_caps),  hn::Set(d, c.id)};
}

/// Those of a block: `get` takes a column to a vector.
template <typename T, class Get>
HWY_INLINE auto lanes_of(const ConeBlock<T>& block, Get get) {
  const auto axis = [&](std::size_t i) HWY_ATTR {
    return V3<decltype(get(block.id))>{get(block.axes[i]), get(block.axes[i + 1]),
                                       get(block.axes[i + 2])};
  };
  return Cones<decltype(get(block.id))>{axis(0),
                                        axis(3),
                                        axis(6),
                                        get(block.distance),
                                        get(block.sine),
                                        get(block.girth),
                                        get(block.low),
                                        get(block.high),
                                        get(block.low_girth2),
                                        get(block.high_girth2),
                                        get(block.has_caps),
                                        get(block.id)};
}

/// A place or a direction as cones see it: across the axis, in cosines, and along it, and the girth
/// there or what it grows by.
template <class V>
struct AlongCone {
  V u;
  V v;
  V w;
  V girth;
};
template <class V>
HWY_INLINE AlongCone<V> direction_along(const Cones<V>& c, const V3<V>& a) {
  const V w = dot(c.axis, a);
  return {dot(c.across, a), dot(c.towards, a), w, hn::Mul(c.sine, w)};
}
template <class V>
HWY_INLINE AlongCone<V> place_along(const Cones<V>& c, const V3<V>& a) {
  const V w = dot(c.axis, a);
  return {dot(c.across, a), hn::Sub(dot(c.towards, a), c.distance), w,
          hn::MulAdd(c.sine, w, c.girth)};
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
HWY_INLINE ConeChords<V, M> chords_of(D d, const Cones<V>& c, const AlongCone<V>& f,
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

/// Lanes that meet a closed cone from outside, and where: a chord counts if its middle is ahead, so
/// that a point in the surface, or inside of it by rounding, is left outwards without meeting it.
template <class D, class V, class M = hn::Mask<D>>
HWY_INLINE M enter_closed(D d, const ConeChords<V, M>& chords, V& t) {
  const V zero = hn::Zero(d);
  t = hn::Max(chords.enter, zero);
  return hn::And(chords.is_there, hn::Gt(hn::Add(chords.enter, chords.leave), zero));
}

/// Lanes that meet the side of an open cone, from outside or inside.
template <class D, class V, class M = hn::Mask<D>>
HWY_INLINE M hit_open(D d, const ConeChords<V, M>& chords, V& t) {
  const V zero = hn::Zero(d);
  const M outside = hn::AndNot(chords.enters_disc, hn::Gt(chords.enter, zero));
  const M inside = hn::AndNot(chords.leaves_disc, hn::Gt(chords.leave, zero));
  t = hn::IfThenElse(outside, chords.enter, chords.leave);
  return hn::And(chords.is_there, hn::Or(outside, inside));
}

/// The same of rays that begin on a surface, perhaps of this cone.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE M intersect_open(D d, const Cones<V>& c, const RayOrigin<V>& from,
                              const V3<V>& direction, const AlongCone<V>& f, const AlongCone<V>& g,
                              V power, V& t) {
  const V zero = hn::Zero(d);
  // A power that is less than the rounding of the place counts as none.
  const V girth = hn::Sqrt(hn::MulAdd(f.u, f.u, hn::Mul(f.v, f.v)));
  const V reach = hn::Add(hn::Add(girth, hn::Abs(f.girth)), hn::Add(hn::Abs(f.w), c.distance));
  const V noise = hn::Mul(hn::Set(d, 8 * std::numeric_limits<T>::epsilon()),
                          hn::Mul(reach, hn::Add(girth, hn::Abs(f.girth))));
  power = hn::IfThenZeroElse(hn::Lt(hn::Abs(power), noise), power);
  const ConeChords<V, M> chords = chords_of(d, c, f, g, power);
  const M is_hit = hit_open(d, chords, t);
  const M leaves = hn::Eq(from.id, c.id);
  if (hn::AllFalse(d, leaves)) return is_hit;
  // From inside, to the other side: 2 b / a, where b is exact by the normal.
  const AlongCone<V> n = direction_along(c, from.normal);
  const V outward = hn::NegMulAdd(n.girth, girth, hn::MulAdd(f.u, n.u, hn::Mul(f.v, n.v)));
  const V b = hn::Mul(girth, dot(from.normal, direction));
  const V across = hn::Div(hn::Add(b, b), at_least(d, chords.a, least_divisor<T>));
  const V slope = at_least(d, g.w, least_divisor<T>);
  const V end = hn::IfThenElse(hn::Gt(slope, zero), c.high, c.low);
  const M between =
      hn::And(hn::Gt(across, zero), hn::Le(across, hn::Div(hn::Sub(end, f.w), slope)));
  t = hn::IfThenElse(leaves, across, t);
  return hn::Or(hn::And(hn::And(leaves, hn::Lt(outward, zero)), between),
                hn::AndNot(leaves, is_hit));
}

/// Lanes of `active` whose rays meet their cone, at t. No ray begins inside a closed one.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M intersect_cones(D d, const Cones<V>& c, const RayOrigin<V>& from,
                             const V3<V>& direction, M active, V& t) {
  const AlongCone<V> g = direction_along(c, direction);
  const AlongCone<V> f = place_along(c, from.point);
  const V power = hn::NegMulAdd(f.girth, f.girth, hn::MulAdd(f.u, f.u, hn::Mul(f.v, f.v)));
  const M is_closed = hn::Gt(c.has_caps, hn::Zero(d));
  const M closed = hn::And(active, is_closed);
  const M open = hn::AndNot(is_closed, active);
  M is_hit = hn::Lt(power, power);
  t = hn::Zero(d);
  if (HWY_LIKELY(!hn::AllFalse(d, closed))) {
    const ConeChords<V, M> chords = chords_of(d, c, f, g, power);
    is_hit = hn::And(hn::AndNot(hn::Eq(from.id, c.id), enter_closed(d, chords, t)), closed);
  }
  if (HWY_UNLIKELY(!hn::AllFalse(d, open))) {
    V t_open;
    const M hits_open = hn::And(open, intersect_open(d, c, from, direction, f, g, power, t_open));
    t = hn::IfThenElse(open, t_open, t);
    is_hit = hn::Or(is_hit, hits_open);
  }
  return is_hit;
}

/// The same of rays that may begin inside.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M intersect_cones(D d, const Cones<V>& c, const InnerOrigin<V>& from,
                             const V3<V>& direction, M active, V& t) {
  const M is_closed = hn::Gt(c.has_caps, hn::Zero(d));
  const M is_hit = hn::AndNot(
      is_closed,
      intersect_cones(d, c, static_cast<const RayOrigin<V>&>(from), direction, active, t));
  const AlongCone<V> g = direction_along(c, direction);
  const AlongCone<V> f = place_along(c, from.point);
  const V across2 = hn::MulAdd(f.u, f.u, hn::Mul(f.v, f.v));
  const V power = hn::NegMulAdd(f.girth, f.girth, across2);
  const ConeChords<V, M> found = chords_of(d, c, f, g, power);
  const AlongCone<V> n = direction_along(c, from.normal);
  const V half = hn::Set(d, T(0.5));
  const V from_middle = hn::NegMulAdd(half, hn::Add(c.low, c.high), f.w);
  const V outward = hn::MulAdd(f.u, n.u, hn::MulAdd(f.v, n.v, hn::Mul(from_middle, n.w)));
  const Chords<V, M> chords{found.is_there, found.enter, found.leave,
                            place_noise(d, from.point, hn::Sqrt(across2)), found.enters_disc};
  V t_closed;
  const M hits_closed =
      hn::And(hn::And(active, is_closed), meet_solid(d, chords, from, c.id, outward, t_closed));
  t = hn::IfThenElse(is_closed, t_closed, t);
  return hn::Or(is_hit, hits_closed);
}

/// What finders/tree-inl.h asks for: lanes whose rays meet their cones, at t.
template <class D, class Origin, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE M intersect(D d, const Cones<V>& c, const TreeRays<V, Origin>& rays, M active, V& t) {
  return intersect_cones(d, c, rays.from, rays.direction, active, t);
}

/// The packet against one cone.
template <class D, class Origin, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE void intersect_item(D d, const Geometry<ConeKind, T>&, const ConeItem<T>& item,
                               const Origin& from, const V3<V>& direction, M active, Hit<V>& hit) {
  const Cones<V> c = in_all_lanes(d, item);
  V t;
  const M is_hit = intersect_cones(d, c, from, direction, active, t);
  if (hn::AllFalse(d, is_hit)) return;
  take(hit, is_nearer(hit, t, c.id, is_hit), t, c.id);
}

/// Rays from the eye against cone `index`, which the eye is not inside of.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void intersect_candidate(D d, const PrimitiveRows<T>&,
                                    const Geometry<ConeKind, T>& cones, std::uint32_t index,
                                    const V3<V>& direction, Hit<V>& hit) {
  const ConeItem<T>& item = cones.items[index];
  const Cones<V> c = in_all_lanes(d, item);
  const V zero = hn::Zero(d);
  const ConeChords<V, M> chords =
      chords_of(d, c, AlongCone<V>{zero, hn::Neg(c.distance), zero, c.girth},
                direction_along(c, direction), hn::Set(d, item.eye_c));
  V t;
  const M is_hit = item.has_caps > 0 ? enter_closed(d, chords, t) : hit_open(d, chords, t);
  take(hit, is_nearer(hit, t, c.id, is_hit), t, c.id);
}

/// Asks the memory for what the function above reads.
template <typename T>
HWY_INLINE void prefetch_candidate(const PrimitiveRows<T>&, const Geometry<ConeKind, T>& cones,
                                   std::uint32_t index) {
  hwy::Prefetch(&cones.items[index]);
}

/// Lanes from which a cone hides a point light; it is relative to that.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M hides_point_light(D d, const ConeItem<T>& item, const LampRays<D>& lamp, V own_id) {
  const Cones<V> c = in_all_lanes(d, item);
  const V zero = hn::Zero(d);
  const ConeChords<V, M> chords =
      chords_of(d, c, AlongCone<V>{zero, hn::Neg(c.distance), zero, c.girth},
                direction_along(c, lamp.direction), hn::Set(d, item.eye_c));
  if (item.has_caps > 0)
    return hn::And(hn::And(chords.is_there, hn::Ne(own_id, c.id)),
                   lamp.pass(d, chords.enter, chords.leave));
  const M enters = hn::AndNot(chords.enters_disc, lamp.meet(d, chords.enter));
  const M leaves = hn::AndNot(chords.leaves_disc, lamp.meet(d, chords.leave));
  return hn::And(chords.is_there, hn::Or(enters, leaves));
}

/// Lanes of `lit` from which a cone stands before the light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE M occluded_by(D d, const Geometry<ConeKind, T>& cones, const PacketLight<T>& light,
                           const ShadowRays<V>& rays, M lit) {
  const ConeLightView<T>& view = cones.lights[light.index];
  const auto occluded = [&](const auto& hides) HWY_ATTR {
    if (light.rays == LightRays::parallel) {
      if (cones.finder(ray_kind_of(light)) == Finder::light_grid)
        return occluded_by_listed(d, view.grid, places_on(d, view.grid.plane, rays.from.point), lit,
                                  hides);
    } else if (cones.finder(RayKind::to_point_light) == Finder::point_grid) {
      return occluded_by_listed(d, view.lamp.lists, light.place, rays, lit, hides);
    }
    return occluded_by_items(d, cones.items.size(), lit, hides);
  };
  if (view.lamp.seen.empty()) {
    // Met before the light, which may be inside; one in whose surface it lies does not hide it.
    const V distance = hn::Mul(rays.path, hn::Set(d, nearer_than_light<T>));
    return occluded([&](std::size_t i, M rest, M& hidden) RAYTRACER_INLINE_ATTR {
      V t;
      const M is_hit =
          intersect_cones(d, in_all_lanes(d, cones.items[i]), rays.from, rays.towards, rest, t);
      hidden = hn::And(is_hit, hn::Lt(t, distance));
      return !hn::AllFalse(d, hidden);
    });
  }
  const LampRays<D> lamp(d, rays);
  return occluded([&](std::size_t i, M rest, M& hidden) RAYTRACER_INLINE_ATTR {
    hidden = hn::And(rest, hides_point_light(d, view.lamp.seen[i], lamp, rays.from.id));
    return !hn::AllFalse(d, hidden);
  });
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
