// What packets of rays need of kinds of surfaces of revolution, of any whose own code comes before
// this file. In lanes, C, a kind brings
//
//   in_all_lanes(d, item), lanes_of(block, get)  its C, which begins with AxialLanes
//   direction_along(c, a), place_along(c, a), eye_along(d, c)
//                                      as its side sees them, where that is not as AxialLanes do
//   outwards(c, f, n)                  which way a normal looks, likewise
//   rounded_reach(c, f, point)         what is rounded of a place is no larger, likewise
//   breadth(d, c, f)                   how wide it is about a place in its surface, as its side
//                                      measures that
//   power_noise(d, c, f, point)        by what a place's power may be rounded: less than 16 epsilon
//                                      times the square of its reach, or than the power
//   power_of(c, f)                     of a place: positive outside the endless side
//   crossings_of(d, c, f, g, power)    where rays from f along g cross its side and ends
//   closed_chord(d, c, f, g, crossings), side_hits(d, c, f, g, crossings)
//   leave_side(d, c, from, direction, f, g, crossings, t)
//                                      lanes that go from its side's inside to its other side
//
// It may bring, for closed ones under distant lights,
//
//   hides_distant_light(d, shadow, point)  where its LightView has `shadows`, one for each item

#include <hwy/cache_control.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "engine/lights/packet_light.h"
#include "engine/objects/geometry.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

template <class C, class V>
concept AxialLanesOf = std::derived_from<C, AxialLanes<V>>;

/// Lanes that meet a closed solid from outside, and where: a chord counts if its middle is ahead,
/// so that a point in the surface, or inside of it by rounding, is left outwards without meeting
/// it.
template <class D, class V, class M>
HWY_INLINE M enter_closed(D d, const AxialChord<V, M>& chord, V& t) {
  const V zero = hn::Zero(d);
  t = hn::Max(chord.enter, zero);
  return hn::And(chord.is_there, hn::Gt(hn::Add(chord.enter, chord.leave), zero));
}

/// Lanes that meet the side of an open solid, from outside or inside.
template <class D, class V, class M>
HWY_INLINE M meet_open(D d, const SideHits<V, M>& side, V& t) {
  const V zero = hn::Zero(d);
  const M outside = hn::And(side.enters, hn::Gt(side.enter, zero));
  const M inside = hn::And(side.leaves, hn::Gt(side.leave, zero));
  t = hn::IfThenElse(outside, side.enter, side.leave);
  return hn::Or(outside, inside);
}

/// The power of places that are in the side, but for rounding: none. By value, so that whoever asks
/// for it, which is rare, keeps its solids in registers.
template <class D, AxialLanesOf<hn::Vec<D>> C, class Place, class V = hn::Vec<D>>
HWY_NOINLINE V power_without_noise(D d, C c, const Place& f, const V3<V>& point, V power) {
  return hn::IfThenZeroElse(hn::Lt(hn::Abs(power), power_noise(d, c, f, point)), power);
}

/// Lanes of rays that begin in the side of their own open solid and meet its other side, at t.
template <class D, AxialLanesOf<hn::Vec<D>> C, class Place, class Direction, class Crossings,
          class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_NOINLINE M meet_own_side(D d, C c, const RayOrigin<V>& from, const V3<V>& direction,
                             const Place& f, const Direction& g, const Crossings& crossings, V& t) {
  return leave_side(d, c, from, direction, f, g, crossings, t);
}

/// Lanes of `active` whose rays meet their solid, at t. No ray begins inside a closed one.
template <class D, AxialLanesOf<hn::Vec<D>> C, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE M intersect(D d, const C& c, const RayOrigin<V>& from, const V3<V>& direction, M active,
                       V& t) {
  const auto g = direction_along(c, direction);
  const auto f = place_along(c, from.point);
  const M is_closed = hn::Gt(c.has_caps, hn::Zero(d));
  const M closed = hn::And(active, is_closed);
  const M open = hn::AndNot(is_closed, active);
  const bool has_open = !hn::AllFalse(d, open);
  V power = power_of(c, f);
  if (has_open) {
    // Of most places it is far more than its rounding.
    const V reach = rounded_reach(c, f, from.point);
    const V far_more =
        hn::Mul(hn::Set(d, 16 * std::numeric_limits<T>::epsilon()), hn::Mul(reach, reach));
    const M is_near = hn::And(open, hn::Lt(hn::Abs(power), far_more));
    if (HWY_UNLIKELY(!hn::AllFalse(d, is_near)))
      power = hn::IfThenElse(is_near, power_without_noise(d, C(c), f, from.point, power), power);
  }
  const auto crossings = crossings_of(d, c, f, g, power);
  M is_hit = hn::Lt(power, power);
  t = hn::Zero(d);
  if (HWY_LIKELY(!hn::AllFalse(d, closed))) {
    const M hits_closed = enter_closed(d, closed_chord(d, c, f, g, crossings), t);
    is_hit = hn::And(hn::AndNot(hn::Eq(from.id, c.id), hits_closed), closed);
  }
  if (has_open) {
    V t_open;
    M hits_open = hn::And(open, meet_open(d, side_hits(d, c, f, g, crossings), t_open));
    const M leaves = hn::And(open, hn::Eq(from.id, c.id));
    if (HWY_UNLIKELY(!hn::AllFalse(d, leaves))) {
      V across;
      const M meets_other = meet_own_side(d, C(c), from, direction, f, g, crossings, across);
      t_open = hn::IfThenElse(leaves, across, t_open);
      hits_open = hn::Or(hn::And(leaves, meets_other), hn::AndNot(leaves, hits_open));
    }
    t = hn::IfThenElse(open, t_open, t);
    is_hit = hn::Or(is_hit, hits_open);
  }
  return is_hit;
}

/// The same of rays that may begin inside.
template <class D, AxialLanesOf<hn::Vec<D>> C, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE M intersect(D d, const C& c, const InnerOrigin<V>& from, const V3<V>& direction,
                       M active, V& t) {
  const M is_closed = hn::Gt(c.has_caps, hn::Zero(d));
  const M is_hit = hn::AndNot(
      is_closed, intersect(d, c, static_cast<const RayOrigin<V>&>(from), direction, active, t));
  const auto g = direction_along(c, direction);
  const auto f = place_along(c, from.point);
  const auto crossings = crossings_of(d, c, f, g, power_of(c, f));
  const AxialChord<V, M> chord = closed_chord(d, c, f, g, crossings);
  const auto n = direction_along(c, from.normal);
  const V middle = hn::Mul(hn::Set(d, T(0.5)), hn::Add(c.low, c.high));
  const InAxes<V> from_middle{f.u, f.v, hn::Sub(f.w, middle)};
  const Chords<V, M> chords{chord.is_there, chord.enter, chord.leave,
                            place_noise(d, from.point, breadth(d, c, f)), chord.enters_cap};
  V t_closed;
  const M hits_closed =
      hn::And(hn::And(active, is_closed),
              meet_solid(d, chords, from, c.id, outwards(c, from_middle, n), t_closed));
  t = hn::IfThenElse(is_closed, t_closed, t);
  return hn::Or(is_hit, hits_closed);
}

/// What finders/tree-inl.h asks for: lanes whose rays meet their solids, at t.
template <class D, AxialLanesOf<hn::Vec<D>> C, class Origin, class V = hn::Vec<D>,
          class M = hn::Mask<D>>
HWY_INLINE M intersect(D d, const C& c, const TreeRays<V, Origin>& rays, M active, V& t) {
  return intersect(d, c, rays.from, rays.direction, active, t);
}

/// The packet against one solid.
template <class D, AxialKind Kind, class Origin, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE void intersect_item(D d, const Geometry<Kind, T>&,
                               const typename Geometry<Kind, T>::Layout::Item& item,
                               const Origin& from, const V3<V>& direction, M active, Hit<V>& hit) {
  const auto c = in_all_lanes(d, item);
  V t;
  const M is_hit = intersect(d, c, from, direction, active, t);
  if (hn::AllFalse(d, is_hit)) return;
  take(hit, is_nearer(hit, t, c.id, is_hit), t, c.id);
}

/// Lanes whose rays from the eye along g meet a solid, at t. The eye is not inside of a closed one.
template <class D, AxialLanesOf<hn::Vec<D>> C, class Direction, typename T = hn::TFromD<D>,
          class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE M meet_from_eye(D d, const C& c, const AxialItem<T>& item, const Direction& g, V& t) {
  const auto f = eye_along(d, c);
  const auto crossings = crossings_of(d, c, f, g, hn::Set(d, item.eye_power));
  return item.has_caps > 0 ? enter_closed(d, closed_chord(d, c, f, g, crossings), t)
                           : meet_open(d, side_hits(d, c, f, g, crossings), t);
}

/// Rays from the eye against solid `index`. A kind may know better.
template <class D, AxialKind Kind, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE void intersect_candidate(D d, const PrimitiveRows<T>&, const Geometry<Kind, T>& solids,
                                    std::uint32_t index, const V3<V>& direction, Hit<V>& hit) {
  const auto& item = solids.items[index];
  const auto c = in_all_lanes(d, item);
  V t;
  const M is_hit = meet_from_eye(d, c, item, direction_along(c, direction), t);
  take(hit, is_nearer(hit, t, c.id, is_hit), t, c.id);
}

/// Asks the memory for what the function above reads.
template <AxialKind Kind, typename T>
HWY_INLINE void prefetch_candidate(const PrimitiveRows<T>&, const Geometry<Kind, T>& solids,
                                   std::uint32_t index) {
  hwy::Prefetch(&solids.items[index]);
}

/// Lanes of rays that end in a solid's own side whose surface looks inwards: they came through what
/// is opposite. Where they are met does not tell: of a small solid far from the light it is rounded
/// by more than LampRays allows for.
template <class D, AxialLanesOf<hn::Vec<D>> C, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE M end_within(D d, const C& c, const LampRays<D>& lamp, const V3<V>& normal) {
  const auto f = place_along(c, scale(lamp.direction, lamp.path));
  const V middle = hn::Mul(hn::Set(d, T(0.5)), hn::Add(c.low, c.high));
  const InAxes<V> from_middle{f.u, f.v, hn::Sub(f.w, middle)};
  return hn::Lt(outwards(c, from_middle, direction_along(c, normal)), hn::Zero(d));
}

/// Lanes from which a solid hides a point light; it is relative to that.
template <class D, class Item, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE M hides_point_light(D d, const Item& item, const LampRays<D>& lamp,
                               const RayOrigin<V>& from) {
  const auto c = in_all_lanes(d, item);
  const auto f = eye_along(d, c);
  const auto g = direction_along(c, lamp.direction);
  const auto crossings = crossings_of(d, c, f, g, hn::Set(d, item.eye_power));
  const M own = hn::Eq(from.id, c.id);
  if (item.has_caps > 0) {
    const AxialChord<V, M> chord = closed_chord(d, c, f, g, crossings);
    return hn::And(hn::AndNot(own, chord.is_there), lamp.pass(d, chord.enter, chord.leave));
  }
  const SideHits<V, M> side = side_hits(d, c, f, g, crossings);
  const M hidden = hn::Or(hn::And(side.enters, lamp.meet(d, side.enter)),
                          hn::And(side.leaves, lamp.meet(d, side.leave)));
  if (HWY_LIKELY(hn::AllFalse(d, own))) return hidden;
  const M by_opposite = hn::And(hn::And(side.enters, hn::Gt(side.enter, hn::Zero(d))),
                                end_within(d, c, lamp, from.normal));
  return hn::Or(hn::And(own, by_opposite), hn::AndNot(own, hidden));
}

/// Lanes of `lit` from which a solid stands before the light.
template <class D, AxialKind Kind, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_NOINLINE M occluded_by(D d, const Geometry<Kind, T>& solids, const PacketLight<T>& light,
                           const ShadowRays<V>& rays, M lit) {
  const auto& view = solids.lights[light.index];
  const bool is_distant = light.rays == LightRays::parallel;
  const auto occluded = [&](const auto& hides) HWY_ATTR {
    if (is_distant) {
      if (solids.finder(ray_kind_of(light)) == Finder::light_grid)
        return occluded_by_listed(d, view.grid, places_on(d, view.grid.plane, rays.from.point), lit,
                                  hides);
    } else if (solids.finder(RayKind::to_point_light) == Finder::point_grid) {
      return occluded_by_listed(d, view.lamp.lists, light.place, rays, lit, hides);
    }
    return occluded_by_items(d, solids.items.size(), lit, hides);
  };
  const auto from_point = [&](std::size_t i, M rest, M& hidden) RAYTRACER_INLINE_ATTR {
    V t;
    const M is_hit =
        intersect(d, in_all_lanes(d, solids.items[i]), rays.from, rays.towards, rest, t);
    // Met before the light, which may be inside; one in whose surface it lies does not hide it.
    hidden = hn::And(is_hit, hn::Lt(t, hn::Mul(rays.path, hn::Set(d, nearer_than_light<T>))));
    return !hn::AllFalse(d, hidden);
  };
  if constexpr (requires { view.shadows; }) {
    if (is_distant)
      return occluded([&](std::size_t i, M rest, M& hidden) RAYTRACER_INLINE_ATTR {
        const auto& item = solids.items[i];
        if (!(item.has_caps > 0)) return from_point(i, rest, hidden);
        hidden = hn::And(hn::AndNot(hn::Eq(rays.from.id, hn::Set(d, item.id)), rest),
                         hides_distant_light(d, view.shadows[i], rays.from.point));
        return !hn::AllFalse(d, hidden);
      });
  }
  if (view.lamp.seen.empty()) return occluded(from_point);
  const LampRays<D> lamp(d, rays);
  return occluded([&](std::size_t i, M rest, M& hidden) RAYTRACER_INLINE_ATTR {
    hidden = hn::And(rest, hides_point_light(d, view.lamp.seen[i], lamp, rays.from));
    return !hn::AllFalse(d, hidden);
  });
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
