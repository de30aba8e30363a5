// Packets against cylinders.

#include <hwy/cache_control.h>

#include <cstddef>
#include <cstdint>
#include <limits>

#include "engine/lights/packet_light.h"
#include "engine/objects/cylinder/packets.h"
#include "engine/objects/geometry.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Cylinders, one for each lane's ray, or the same in all lanes.
template <class V>
struct Cylinders {
  V3<V> across;
  V3<V> towards;
  V3<V> axis;
  V distance;
  V radius2;
  V low;
  V high;
  V has_caps;
  V id;
};

template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE Cylinders<V> in_all_lanes(D d, const CylinderItem<T>& c) {
  return {broadcast(d, c.across), broadcast(d, c.towards), broadcast(d, c.axis),
          hn::Set(d, c.distance), hn::Set(d, c.radius2),   hn::Set(d, c.low),
          hn::Set(d, c.high),     hn::Set(d, c.has_caps),  hn::Set(d, c.id)};
}

/// Those of a block: `get` takes a column to a vector.
template <typename T, class Get>
HWY_INLINE auto lanes_of(const CylinderBlock<T>& block, Get get) {
  const auto axis = [&](std::size_t i) HWY_ATTR {
    return V3<decltype(get(block.id))>{get(block.axes[i]), get(block.axes[i + 1]),
                                       get(block.axes[i + 2])};
  };
  return Cylinders<decltype(get(block.id))>{axis(0),
                                            axis(3),
                                            axis(6),
                                            get(block.distance),
                                            get(block.radius2),
                                            get(block.low),
                                            get(block.high),
                                            get(block.has_caps),
                                            get(block.id)};
}

/// A vector in a cylinder's own axes: across, towards and axis.
template <class V>
struct InAxes {
  V u;
  V v;
  V w;
};
template <class V>
HWY_INLINE InAxes<V> in_axes(const Cylinders<V>& c, const V3<V>& a) {
  return {dot(c.across, a), dot(c.towards, a), dot(c.axis, a)};
}

/// Where rays are within the endless cylinder, and between its ends; nowhere where enter > leave.
template <class V, class M>
struct CylinderSpans {
  V enter_side;
  V leave_side;
  V enter_ends;
  V leave_ends;
  M crosses;  ///< the endless cylinder
};

/// A direction along the axis is taken a little aslant: no quotient is then other than a number.
template <typename T>
inline constexpr T least_square = sizeof(T) == sizeof(float) ? T(1e-30) : T(1e-60);
template <typename T>
inline constexpr T least_slope = sizeof(T) == sizeof(float) ? T(1e-20) : T(1e-60);

/// `f` is from the foot to the rays' origins, `g` their directions, `power` |f|^2 - radius^2 across
/// the axis.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE CylinderSpans<V, M> spans_of(D d, const Cylinders<V>& c, const InAxes<V>& f,
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
  const V least = hn::Set(d, least_slope<T>);
  const V slope = hn::IfThenElse(hn::Lt(hn::Abs(g.w), least), hn::CopySign(least, g.w), g.w);
  const V to_low = hn::Div(hn::Sub(c.low, f.w), slope);
  const V to_high = hn::Div(hn::Sub(c.high, f.w), slope);
  return {hn::IfThenElse(ahead, one, other), hn::IfThenElse(ahead, other, one),
          hn::Min(to_low, to_high), hn::Max(to_low, to_high), hn::Ge(room, zero)};
}

/// Lanes that meet a closed cylinder from outside, and where: a chord counts if its middle is
/// ahead, so that a point in the surface, or inside of it by rounding, is left outwards without
/// meeting it.
template <class D, class V, class M = hn::Mask<D>>
HWY_INLINE M enter_closed(D d, const CylinderSpans<V, M>& spans, V& t) {
  const V enter = hn::Max(spans.enter_side, spans.enter_ends);
  const V leave = hn::Min(spans.leave_side, spans.leave_ends);
  t = hn::Max(enter, hn::Zero(d));
  const M ahead = hn::Gt(hn::Add(enter, leave), hn::Zero(d));
  return hn::And(hn::And(spans.crosses, hn::Le(enter, leave)), ahead);
}

/// Lanes that meet an open cylinder, from outside or inside.
template <class D, class V, class M = hn::Mask<D>>
HWY_INLINE M hit_open(D d, const CylinderSpans<V, M>& spans, V& t) {
  const auto is_between = [&](V at) HWY_ATTR {
    return hn::And(hn::Gt(at, hn::Zero(d)),
                   hn::And(hn::Ge(at, spans.enter_ends), hn::Le(at, spans.leave_ends)));
  };
  const M outside = is_between(spans.enter_side);
  t = hn::IfThenElse(outside, spans.enter_side, spans.leave_side);
  return hn::And(spans.crosses, hn::Or(outside, is_between(spans.leave_side)));
}

/// The same of rays that begin on a surface, perhaps of this cylinder.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE M intersect_open(D d, const Cylinders<V>& c, const RayOrigin<V>& from,
                              const InAxes<V>& f, const InAxes<V>& g, V power, V& t) {
  const V zero = hn::Zero(d);
  // A power that is less than the rounding of the place counts as none.
  const V reach = hn::Add(hn::Add(hn::Abs(f.u), hn::Abs(f.v)), hn::Add(hn::Abs(f.w), c.distance));
  const V radius = hn::Sqrt(hn::Max(c.radius2, zero));
  const V noise =
      hn::Mul(hn::Set(d, 8 * std::numeric_limits<T>::epsilon()), hn::Mul(reach, radius));
  power = hn::IfThenZeroElse(hn::Lt(hn::Abs(power), noise), power);
  const CylinderSpans<V, M> spans = spans_of(d, c, f, g, power);
  const M is_hit = hit_open(d, spans, t);
  const M leaves = hn::Eq(from.id, c.id);
  if (hn::AllFalse(d, leaves)) return is_hit;
  // From inside, to the other side: 2 b / a, where b is exact by the normal.
  const InAxes<V> n = in_axes(c, from.normal);
  const M inwards = hn::Lt(hn::MulAdd(f.u, n.u, hn::Mul(f.v, n.v)), zero);
  const V a = hn::Max(hn::MulAdd(g.u, g.u, hn::Mul(g.v, g.v)), hn::Set(d, least_square<T>));
  const V slant = hn::MulAdd(n.u, g.u, hn::Mul(n.v, g.v));
  const V across = hn::Div(hn::Mul(hn::Add(slant, slant), radius), a);
  const M between = hn::And(hn::Gt(across, zero), hn::Le(across, spans.leave_ends));
  t = hn::IfThenElse(leaves, across, t);
  return hn::Or(hn::And(leaves, hn::And(inwards, between)), hn::AndNot(leaves, is_hit));
}

/// Lanes of `active` whose rays meet their cylinder, at t. No ray begins inside a closed one.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M intersect_cylinders(D d, const Cylinders<V>& c, const RayOrigin<V>& from,
                                 const V3<V>& direction, M active, V& t) {
  const InAxes<V> g = in_axes(c, direction);
  InAxes<V> f = in_axes(c, from.point);
  f.v = hn::Sub(f.v, c.distance);
  const V power = hn::Sub(hn::MulAdd(f.u, f.u, hn::Mul(f.v, f.v)), c.radius2);
  const M is_closed = hn::Gt(c.has_caps, hn::Zero(d));
  const M closed = hn::And(active, is_closed);
  const M open = hn::AndNot(is_closed, active);
  M is_hit = hn::Lt(power, power);
  t = hn::Zero(d);
  if (HWY_LIKELY(!hn::AllFalse(d, closed))) {
    const M hits_closed = enter_closed(d, spans_of(d, c, f, g, power), t);
    is_hit = hn::And(hn::AndNot(hn::Eq(from.id, c.id), hits_closed), closed);
  }
  if (HWY_UNLIKELY(!hn::AllFalse(d, open))) {
    V t_open;
    const M hits_open = hn::And(open, intersect_open(d, c, from, f, g, power, t_open));
    t = hn::IfThenElse(open, t_open, t);
    is_hit = hn::Or(is_hit, hits_open);
  }
  return is_hit;
}

/// The same of rays that may begin inside.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M intersect_cylinders(D d, const Cylinders<V>& c, const InnerOrigin<V>& from,
                                 const V3<V>& direction, M active, V& t) {
  const M is_closed = hn::Gt(c.has_caps, hn::Zero(d));
  M is_hit = hn::AndNot(is_closed, intersect_cylinders(d, c, static_cast<const RayOrigin<V>&>(from),
                                                       direction, active, t));
  const InAxes<V> g = in_axes(c, direction);
  InAxes<V> f = in_axes(c, from.point);
  f.v = hn::Sub(f.v, c.distance);
  const V power = hn::Sub(hn::MulAdd(f.u, f.u, hn::Mul(f.v, f.v)), c.radius2);
  const CylinderSpans<V, M> spans = spans_of(d, c, f, g, power);
  const V enter = hn::Max(spans.enter_side, spans.enter_ends);
  const V leave = hn::Min(spans.leave_side, spans.leave_ends);
  const InAxes<V> n = in_axes(c, from.normal);
  const V half = hn::Set(d, T(0.5));
  const V from_middle = hn::NegMulAdd(half, hn::Add(c.low, c.high), f.w);
  const V outward = hn::MulAdd(f.u, n.u, hn::MulAdd(f.v, n.v, hn::Mul(from_middle, n.w)));
  const V noise = place_noise(d, from.point, hn::Sqrt(hn::Max(c.radius2, hn::Zero(d))));
  const Chords<V, M> chords{hn::And(spans.crosses, hn::Le(enter, leave)), enter, leave, noise,
                            hn::Gt(spans.enter_ends, spans.enter_side)};
  V t_closed;
  const M hits_closed =
      hn::And(hn::And(active, is_closed), meet_solid(d, chords, from, c.id, outward, t_closed));
  t = hn::IfThenElse(is_closed, t_closed, t);
  return hn::Or(is_hit, hits_closed);
}

/// What finders/tree-inl.h asks for: lanes whose rays meet their cylinders, at t.
template <class D, class Origin, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE M intersect(D d, const Cylinders<V>& c, const TreeRays<V, Origin>& rays, M active,
                       V& t) {
  return intersect_cylinders(d, c, rays.from, rays.direction, active, t);
}

/// The packet against one cylinder.
template <class D, class Origin, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE void intersect_item(D d, const Geometry<CylinderKind, T>&, const CylinderItem<T>& item,
                               const Origin& from, const V3<V>& direction, M active, Hit<V>& hit) {
  const Cylinders<V> c = in_all_lanes(d, item);
  V t;
  const M is_hit = intersect_cylinders(d, c, from, direction, active, t);
  if (hn::AllFalse(d, is_hit)) return;
  take(hit, is_nearer(hit, t, c.id, is_hit), t, c.id);
}

/// Rays from the eye against cylinder `index`, which the eye is not inside of.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void intersect_candidate(D d, const PrimitiveRows<T>&,
                                    const Geometry<CylinderKind, T>& cylinders, std::uint32_t index,
                                    const V3<V>& direction, Hit<V>& hit) {
  const CylinderItem<T>& item = cylinders.items[index];
  const Cylinders<V> c = in_all_lanes(d, item);
  const V zero = hn::Zero(d);
  const InAxes<V> g = in_axes(c, direction);
  if (!(item.eye_c > 0)) {  // within the endless cylinder
    const CylinderSpans<V, M> spans =
        spans_of(d, c, InAxes<V>{zero, hn::Neg(c.distance), zero}, g, hn::Set(d, item.eye_c));
    V t;
    const M is_hit = item.has_caps > 0 ? enter_closed(d, spans, t) : hit_open(d, spans, t);
    return take(hit, is_nearer(hit, t, c.id, is_hit), t, c.id);
  }
  // The side is met from outside, if at all.
  const V a = hn::MulAdd(g.u, g.u, hn::Mul(g.v, g.v));
  const V b = hn::Mul(c.distance, g.v);
  const V x = hn::Mul(c.distance, g.u);
  const V room = hn::NegMulAdd(x, x, hn::Mul(c.radius2, a));
  const M crosses = hn::And(hn::Ge(room, zero), hn::Gt(b, zero));
  const V q = hn::Add(b, hn::Sqrt(hn::Max(room, zero)));
  V t = hn::Div(hn::Set(d, item.eye_c), q);
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

/// Asks the memory for what the function above reads.
template <typename T>
HWY_INLINE void prefetch_candidate(const PrimitiveRows<T>&,
                                   const Geometry<CylinderKind, T>& cylinders,
                                   std::uint32_t index) {
  hwy::Prefetch(&cylinders.items[index]);
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

/// Lanes from which a cylinder hides a point light; it is relative to that.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M hides_point_light(D d, const CylinderItem<T>& item, const LampRays<D>& lamp,
                               V own_id) {
  const Cylinders<V> c = in_all_lanes(d, item);
  const V zero = hn::Zero(d);
  const CylinderSpans<V, M> spans = spans_of(d, c, InAxes<V>{zero, hn::Neg(c.distance), zero},
                                             in_axes(c, lamp.direction), hn::Set(d, item.eye_c));
  if (item.has_caps > 0) {
    const V enter = hn::Max(spans.enter_side, spans.enter_ends);
    const V leave = hn::Min(spans.leave_side, spans.leave_ends);
    const M other = hn::And(spans.crosses, hn::Ne(own_id, c.id));
    return hn::And(hn::And(other, hn::Le(enter, leave)), lamp.pass(d, enter, leave));
  }
  const auto is_met = [&](V at) HWY_ATTR {
    const M between = hn::And(hn::Ge(at, spans.enter_ends), hn::Le(at, spans.leave_ends));
    return hn::And(between, lamp.meet(d, at));
  };
  return hn::And(spans.crosses, hn::Or(is_met(spans.enter_side), is_met(spans.leave_side)));
}

/// Lanes of `lit` from which a cylinder stands before the light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE M occluded_by(D d, const Geometry<CylinderKind, T>& cylinders,
                           const PacketLight<T>& light, const ShadowRays<V>& rays, M lit) {
  const CylinderLightView<T>& view = cylinders.lights[light.index];
  const V own_id = rays.from.id;
  const auto from_point = [&](std::size_t i, M rest, M& hidden) RAYTRACER_INLINE_ATTR {
    V t;
    const M is_hit = intersect_cylinders(d, in_all_lanes(d, cylinders.items[i]), rays.from,
                                         rays.towards, rest, t);
    // Met before the light, which may be inside; one in whose surface it lies does not hide it.
    hidden = hn::And(is_hit, hn::Lt(t, hn::Mul(rays.path, hn::Set(d, nearer_than_light<T>))));
    return !hn::AllFalse(d, hidden);
  };
  if (light.rays == LightRays::parallel) {
    const auto hides = [&](std::size_t i, M rest, M& hidden) RAYTRACER_INLINE_ATTR {
      const CylinderItem<T>& item = cylinders.items[i];
      if (!(item.has_caps > 0)) return from_point(i, rest, hidden);
      hidden = hn::And(hn::AndNot(hn::Eq(own_id, hn::Set(d, item.id)), rest),
                       hides_distant_light(d, view.shadows[i], rays.from.point));
      return !hn::AllFalse(d, hidden);
    };
    if (cylinders.finder(ray_kind_of(light)) == Finder::one_by_one)
      return occluded_by_items(d, cylinders.items.size(), lit, hides);
    return occluded_by_listed(d, view.grid, places_on(d, view.grid.plane, rays.from.point), lit,
                              hides);
  }
  const auto occluded = [&](const auto& hides) HWY_ATTR {
    if (cylinders.finder(RayKind::to_point_light) == Finder::one_by_one)
      return occluded_by_items(d, cylinders.items.size(), lit, hides);
    return occluded_by_listed(d, view.lamp.lists, light.place, rays, lit, hides);
  };
  if (view.lamp.seen.empty()) return occluded(from_point);
  const LampRays<D> lamp(d, rays);
  return occluded([&](std::size_t i, M rest, M& hidden) RAYTRACER_INLINE_ATTR {
    hidden = hn::And(rest, hides_point_light(d, view.lamp.seen[i], lamp, own_id));
    return !hn::AllFalse(d, hidden);
  });
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
