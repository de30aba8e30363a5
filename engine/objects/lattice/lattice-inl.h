// Packets against lattices of touching spheres, and the shadows of those.

#include <limits>

#include "engine/lights/packet_light.h"
#include "engine/objects/geometry.h"
#include "engine/objects/lattice/packets.h"
#include "engine/objects/lattice/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Whether a neighbour in the list's cell stands between a sphere's point with `normal` and a
/// distant light, both in the lattice's axes.
///
/// With the point n/2, the neighbour's centre o in cells and the light's direction d, the line
/// passes at the centre's height after b = o.d - n.d/2, and its squared distance there is
/// |o - n/2|^2 - b^2 = 1/4 + (|o|^2 - o.n) - b^2.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M stands_before(D d, const NeighbourCell<T>& cell, const V3<V>& normal,
                           V half_incidence) {
  const V b = hn::Sub(hn::Set(d, cell.forward), half_incidence);
  const V beyond =
      hn::NegMulAdd(normal.x, hn::Set(d, cell.first),
                    hn::NegMulAdd(normal.z, hn::Set(d, cell.second), hn::Set(d, cell.distance2)));
  return hn::And(hn::Ge(hn::Mul(b, b), beyond), hn::Gt(b, hn::Zero(d)));
}

/// Whether a neighbour of a sphere that has them all stands between its point with `normal` and a
/// distant light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M shadowed_amid(D d, const Neighbours<T>& neighbours, const V3<V>& normal, V incidence) {
  const V half_incidence = hn::Mul(hn::Set(d, T(0.5)), incidence);
  M shadowed = hn::Lt(incidence, incidence);
  for (const NeighbourCell<T>& cell : neighbours.cells)
    shadowed = hn::Or(shadowed, stands_before(d, cell, normal, half_incidence));
  return shadowed;
}

/// The same for the sphere in cell (first, second), wherever that is.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M shadowed_by_neighbours(D d, const LatticeItem<T>& lattice,
                                    const Neighbours<T>& neighbours, V first, V second,
                                    const V3<V>& normal, V incidence, M active) {
  const auto within = [&](V place, T low, T high, T reach) HWY_ATTR {
    return hn::And(hn::Ge(place, hn::Set(d, low + reach)), hn::Le(place, hn::Set(d, high - reach)));
  };
  const M amid = hn::And(within(first, lattice.low_first, lattice.high_first, neighbours.reach),
                         within(second, lattice.low_second, lattice.high_second, neighbours.reach));
  if (hn::AllTrue(d, hn::Or(amid, hn::Not(active))))
    return hn::And(active, shadowed_amid(d, neighbours, normal, incidence));
  const V half_incidence = hn::Mul(hn::Set(d, T(0.5)), incidence);
  M shadowed = hn::Lt(incidence, incidence);
  for (const NeighbourCell<T>& cell : neighbours.cells) {
    const M is_there = hn::And(
        within(hn::Add(first, hn::Set(d, cell.first)), lattice.low_first, lattice.high_first, T(0)),
        within(hn::Add(second, hn::Set(d, cell.second)), lattice.low_second, lattice.high_second,
               T(0)));
    shadowed = hn::Or(shadowed, hn::And(stands_before(d, cell, normal, half_incidence), is_there));
  }
  return hn::And(shadowed, active);
}

/// Rays of `active` that are inside of a sphere, and where they leave it. `origin` and `slope` are
/// in the lattice's axes and cells; the lanes of `is_left` begin on one of its spheres.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE CellHit<V, M> way_out(D d, const LatticeItem<T>& lattice, const InnerOrigin<V>& from,
                                 const V3<V>& origin, const V3<V>& slope, M is_left, M active) {
  const auto cell = [&](V own, V place, T low, T high) HWY_ATTR {
    const V nearest = hn::Min(hn::Max(hn::Round(place), hn::Set(d, low)), hn::Set(d, high));
    return hn::IfThenElse(is_left, own, nearest);
  };
  const V zero = hn::Zero(d);
  const V first = cell(from.u, origin.x, lattice.low_first, lattice.high_first);
  const V second = cell(from.v, origin.z, lattice.low_second, lattice.high_second);
  const CellPass<V> pass = pass_of(d, origin, slope, first, second);
  // From one side of the surface to the other: twice to the middle, however short that is.
  const V half = hn::IfThenElse(is_left, pass.middle, pass.half);
  const V noise = hn::Mul(place_noise(d, from.point, hn::Set(d, T(0.5) * lattice.unit_per_cell)),
                          hn::Set(d, lattice.cells_per_unit));
  const Chords<V, M> chords{hn::Gt(half, zero), hn::Sub(pass.middle, half),
                            hn::Add(pass.middle, half), noise, hn::Lt(zero, zero)};
  const V outward = dot(along_lattice(lattice, from.normal), pass.from_center);
  const M inside = hn::And(chords.is_there, begins_inside(d, chords, is_left, outward));
  CellHit<V, M> out{hn::And(active, inside), zero, first, second, slope};
  meet_cell(d, pass, slope, chords.leave, half, out);
  return out;
}

/// What rays that may begin inside of spheres meet; `walk(lanes)` finds it for those that do not.
template <class D, class Walk, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE CellHit<V, M> way_out_or(D d, const LatticeItem<T>& lattice, const InnerOrigin<V>& from,
                                    const V3<V>& origin, const V3<V>& slope, M is_left, M active,
                                    const Walk& walk) {
  const CellHit<V, M> out = way_out(d, lattice, from, origin, slope, is_left, active);
  const M rest = hn::AndNot(out.hit, active);
  if (hn::AllFalse(d, rest)) return out;
  const CellHit<V, M> met = walk(rest);
  return {hn::Or(out.hit, met.hit), hn::IfThenElse(out.hit, out.t, met.t),
          hn::IfThenElse(out.hit, out.first, met.first),
          hn::IfThenElse(out.hit, out.second, met.second), select(out.hit, out.normal, met.normal)};
}

/// The packet against the lattices. Rays that begin on one of their spheres `leaves_cell`.
template <bool leaves_cell, class D, class Origin, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE void intersect_own(D d, const Geometry<LatticeKind, T>& lattices, const Origin& from,
                              const V3<V>& direction, M active, Hit<V>& hit) {
  // In registers: what a function out of line is told of stays in memory.
  V hit_t = hit.t;
  V hit_id = hit.id;
  V first = hit.u;
  V second = hit.v;
  V3<V> normal = hit.normal;
  bool is_first_lattice = true;
  for (const LatticeItem<T>& lattice : lattices.items) {
    const V to_cells = hn::Set(d, lattice.cells_per_unit);
    const V3<V> eye = broadcast(d, lattice.eye);
    const V3<V> slope = along_lattice(lattice, direction);
    // Generous: whether it is nearer than what else is met is decided below, whoever is asked
    // first.
    const V t_max = hn::Mul(hit_t, hn::Mul(to_cells, hn::Set(d, generous<T>)));
    const V id = hn::Set(d, lattice.id);
    CellHit<V, M> found;
    if (!leaves_cell && is_outside_slab(lattice)) {
      found = first_in_rows(d, lattice, slope, t_max, active);
    } else {
      const V3<V> origin =
          leaves_cell ? mul_add(along_lattice(lattice, from.point), to_cells, eye) : eye;
      const M leaves = hn::Eq(from.id, id);
      const V nowhere = hn::Set(d, std::numeric_limits<T>::max());
      const auto walk = [&](M lanes) HWY_ATTR {
        return walk_lattice<leaves_cell>(d, lattice, origin, slope, t_max, lanes,
                                         hn::IfThenElse(leaves, from.u, nowhere),
                                         hn::IfThenElse(leaves, from.v, nowhere));
      };
      if constexpr (may_be_inside<Origin>)
        found = way_out_or(d, lattice, from, origin, slope, leaves, active, walk);
      else
        found = walk(active);
    }
    const V t = hn::Mul(found.t, hn::Set(d, lattice.unit_per_cell));
    const M nearer = is_nearer(hit_t, hit_id, t, id, found.hit);
    hit_t = hn::IfThenElse(nearer, t, hit_t);
    hit_id = hn::IfThenElse(nearer, id, hit_id);
    const V3<V> found_normal = from_lattice(lattice, found.normal);
    if (is_first_lattice) {  // of no lane that met something else does it matter
      first = found.first;
      second = found.second;
      normal = found_normal;
    } else {
      first = hn::IfThenElse(nearer, found.first, first);
      second = hn::IfThenElse(nearer, found.second, second);
      normal = select(nearer, found_normal, normal);
    }
    is_first_lattice = false;
  }
  hit.t = hit_t;
  hit.id = hit_id;
  hit.u = first;
  hit.v = second;
  hit.normal = normal;
}

/// Lanes of `lit` whose rays meet a sphere of the lattice nearer than `distance`.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE M hidden_by_walk(D d, const LatticeItem<T>& lattice, const ShadowRays<V>& rays,
                              V distance, M lit) {
  const RayOrigin<V>& from = rays.from;
  const M leaves = hn::Eq(from.id, hn::Set(d, lattice.id));
  const V to_cells = hn::Set(d, lattice.cells_per_unit);
  const V3<V> origin =
      mul_add(along_lattice(lattice, from.point), to_cells, broadcast(d, lattice.eye));
  const V nowhere = hn::Set(d, std::numeric_limits<T>::max());
  const V t_max = hn::Mul(distance, to_cells);
  const CellHit<V, M> found = walk_lattice<true>(
      d, lattice, origin, along_lattice(lattice, rays.towards), t_max, lit,
      hn::IfThenElse(leaves, from.u, nowhere), hn::IfThenElse(leaves, from.v, nowhere));
  return hn::And(found.hit, hn::Lt(found.t, t_max));
}

/// Lanes of `lit` from which a sphere of one lattice stands before the light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_by_lattice(D d, const LatticeItem<T>& lattice,
                                 const Neighbours<T>& neighbours, const ShadowRays<V>& rays,
                                 M lit) {
  const RayOrigin<V>& from = rays.from;
  const V distance = hn::Mul(rays.path, hn::Set(d, nearer_than_light<T>));
  const M leaves = hn::Eq(from.id, hn::Set(d, lattice.id));
  M dark = hn::Lt(distance, hn::Zero(d));
  if (neighbours.suffices) {
    const M own = hn::And(lit, leaves);
    if (!hn::AllFalse(d, own))
      dark = shadowed_by_neighbours(d, lattice, neighbours, from.u, from.v,
                                    along_lattice(lattice, from.normal), rays.incidence, own);
    lit = hn::AndNot(leaves, lit);
  }
  // What rises from above the lattice, or sinks from below, does not meet it.
  const V height = hn::MulAdd(along_lattice(lattice, from.point).y,
                              hn::Set(d, lattice.cells_per_unit), hn::Set(d, lattice.eye.y));
  const V rise = along_lattice(lattice, rays.towards).y;
  const V half = hn::Set(d, T(0.5));
  const M departs = hn::Or(hn::And(hn::Ge(height, half), hn::Gt(rise, hn::Zero(d))),
                           hn::And(hn::Le(height, hn::Neg(half)), hn::Lt(rise, hn::Zero(d))));
  lit = hn::AndNot(departs, lit);
  if (HWY_LIKELY(hn::AllFalse(d, lit))) return dark;
  return hn::Or(dark, hidden_by_walk(d, lattice, rays, distance, lit));
}

/// Lanes of `lit` from which a lattice hides the light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_by(D d, const Geometry<LatticeKind, T>& lattices, const PacketLight<T>& light,
                         const ShadowRays<V>& rays, M lit) {
  M dark = hn::Lt(hn::Zero(d), hn::Zero(d));
  for (std::size_t i = 0; i < lattices.items.size(); ++i)
    dark = hn::Or(dark, occluded_by_lattice(d, lattices.items[i], lattices.lights[light.index][i],
                                            rays, hn::AndNot(dark, lit)));
  return dark;
}

/// Sets where the rays of the lanes of `own` meet the spheres of lattices that they are known to
/// hit, and the normals there; an InnerOrigin is inside of those spheres.
template <class D, class Origin, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE void own_distances(D d, const PrimitiveRows<T>&,
                              const Geometry<LatticeKind, T>& lattices, const Origin& from,
                              const V3<V>& direction, M own, Hit<V>& hit) {
  for (const LatticeItem<T>& lattice : lattices.items) {
    const V3<V> origin = mul_add(along_lattice(lattice, from.point),
                                 hn::Set(d, lattice.cells_per_unit), broadcast(d, lattice.eye));
    const V3<V> slope = along_lattice(lattice, direction);
    const M met = hn::And(own, hn::Eq(hit.id, hn::Set(d, lattice.id)));
    CellHit<V, M> found{met, hit.t, hit.u, hit.v, hit.normal};
    if constexpr (may_be_inside<Origin>)
      measure_way_out(d, origin, slope, found);
    else
      measure(d, origin, slope, found);
    // Where spheres touch what is left may be no number.
    const M is_ahead = hn::And(hn::Ge(found.t, hn::Zero(d)),
                               hn::Lt(found.t, hn::Set(d, std::numeric_limits<T>::max())));
    const M here = hn::And(met, is_ahead);
    hit.t = hn::IfThenElse(here, hn::Mul(found.t, hn::Set(d, lattice.unit_per_cell)), hit.t);
    hit.normal = select(here, from_lattice(lattice, found.normal), hit.normal);
  }
}

/// Tells of the lanes of `own` that hit one of their spheres on which side, as tell_sides() has it;
/// those of `within` may have come from inside of something.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void own_sides(D d, const PrimitiveRows<T>&, const Geometry<LatticeKind, T>& lattices,
                          const V3<V>& direction, M own, M within, RayOrigin<V>& at, V& side) {
  for (const LatticeItem<T>& lattice : lattices.items) {
    const M here = hn::And(own, hn::Eq(at.id, hn::Set(d, lattice.id)));
    const M outwards =
        hn::And(hn::And(here, within), hn::Gt(dot(at.normal, direction), hn::Zero(d)));
    side = hn::IfThenElse(here, hn::IfThenElseZero(outwards, hn::Set(d, T(1))), side);
    at.normal = select(outwards, negate(at.normal), at.normal);
  }
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
