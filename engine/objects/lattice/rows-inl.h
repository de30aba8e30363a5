// Packets from an eye above or below a lattice of touching spheres: row after row of it.
//
// Seen along a row, its spheres are one disc: the ray passes that at a height and, where it does,
// is within the radius of the row's axis line over a stretch of centres whose ends a root gives.
// The first whole number in there is the first sphere of the row that the ray meets; rows are met
// in order. With rows along the larger of the ray's slopes hardly any ray crosses more than two.
//
// All is relative to the point in which the ray crosses the plane of the centres, and mirrored so
// that both slopes are positive.

#include <limits>
#include <utility>

#include "engine/objects/lattice/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Whether the eye is above or below all spheres of the lattice.
template <typename T>
HWY_INLINE bool is_outside_slab(const LatticeItem<T>& lattice) {
  return lattice.eye.y >= T(0.5) || lattice.eye.y <= T(-0.5);
}

/// One of the axes that span a lattice, for each lane turned round if the ray runs against it.
template <class V>
struct TurnedAxis {
  V sign;   ///< -0 in the lanes in which it is turned round
  V slope;  ///< the ray's, not negative
  V place;  ///< where the ray crosses the plane of the centres
  V low;    ///< the cells' coordinates
  V high;

  template <class D, typename T = hn::TFromD<D>>
  HWY_INLINE TurnedAxis(D d, V direction, T eye, V t_plane, T low_cell, T high_cell)
      : slope(hn::Abs(direction)) {
    const auto is_turned = hn::Lt(direction, hn::Zero(d));
    sign = hn::IfThenElseZero(is_turned, hn::Set(d, T(-0.0)));
    place = hn::MulAdd(slope, t_plane, turned(hn::Set(d, eye)));
    const V low_end = hn::Set(d, low_cell);
    const V high_end = hn::Set(d, high_cell);
    low = turned(hn::IfThenElse(is_turned, high_end, low_end));
    high = turned(hn::IfThenElse(is_turned, low_end, high_end));
  }
  /// There and back.
  HWY_INLINE V turned(V coordinate) const { return hn::Xor(coordinate, sign); }
};

/// The nearest sphere met at t <= t_max (in cells) by rays from the eye, which is outside of the
/// slab, for the lanes of `active`. `direction` is in the lattice's axes.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE CellHit<V, M> first_in_rows(D d, const LatticeItem<T>& lattice, const V3<V>& direction,
                                       V t_max, M active) {
  const V zero = hn::Zero(d);
  const V half = hn::Set(d, T(0.5));
  const V one = hn::Set(d, T(1));
  const V quarter = hn::Set(d, T(0.25));
  const bool is_above = lattice.eye.y > 0;
  const V descent = is_above ? hn::Neg(direction.y) : direction.y;
  // A ray as level as this meets nothing nearer than what one in single precision can see.
  active = hn::And(active, hn::Gt(descent, hn::Set(d, T(1e-12))));
  const V inverse_descent = inverse(d, descent);
  const V t_plane = hn::Mul(hn::Set(d, is_above ? lattice.eye.y : -lattice.eye.y), inverse_descent);
  CellHit<V, M> found{hn::Lt(zero, zero), t_max, zero, zero, {zero, zero, zero}};
  active = hn::And(active, hn::Le(hn::NegMulAdd(half, inverse_descent, t_plane), t_max));
  if (hn::AllFalse(d, active)) return found;

  TurnedAxis<V> across(d, direction.x, lattice.eye.x, t_plane, lattice.low_first,
                       lattice.high_first);
  TurnedAxis<V> along(d, direction.z, lattice.eye.z, t_plane, lattice.low_second,
                      lattice.high_second);
  const bool runs_along_first = hn::GetLane(across.slope) > hn::GetLane(along.slope);
  if (runs_along_first) std::swap(across, along);

  // A row's axis passes the ray at the height `slope * f`, f from the row to the crossing point,
  // and at a distance in space of `f * shrink`.
  const V slope = hn::Mul(across.slope, inverse_descent);
  const V slope2 = hn::MulAdd(slope, slope, one);
  const V shrink = inverse_root(d, slope2);
  const V stretch = hn::Mul(shrink, inverse_descent);
  const V drift = hn::Mul(hn::Mul(slope, along.slope), hn::Mul(stretch, shrink));
  const V reach = hn::Mul(half, hn::Mul(slope2, shrink));
  V row = hn::Max(hn::Ceil(hn::Sub(across.place, reach)), across.low);
  const V last = hn::Min(hn::Add(across.place, reach), across.high);
  V found_row = zero;
  V found_place = zero;
  active = hn::And(active, hn::Le(row, last));
  for (int step = 0; !hn::AllFalse(d, active) && step < most_steps; ++step) {
    const V f = hn::Sub(across.place, row);
    const V distance = hn::Mul(f, shrink);
    const V root = hn::Sqrt(hn::Max(hn::NegMulAdd(distance, distance, quarter), zero));
    const V middle = hn::NegMulAdd(drift, f, along.place);
    const V begin = hn::Max(hn::Ceil(hn::NegMulAdd(stretch, root, middle)), along.low);
    const V end = hn::Min(hn::MulAdd(stretch, root, middle), along.high);
    const M is_hit = hn::And(active, hn::Le(begin, end));
    found.hit = hn::Or(found.hit, is_hit);
    found_row = hn::IfThenElse(is_hit, row, found_row);
    found_place = hn::IfThenElse(is_hit, begin, found_place);
    row = hn::Add(row, one);
    active = hn::AndNot(is_hit, hn::And(active, hn::Le(row, last)));
  }

  found.first = across.turned(found_row);
  found.second = along.turned(found_place);
  if (runs_along_first) std::swap(found.first, found.second);
  const V3<V> eye = broadcast(d, lattice.eye);
  measure(d, eye, direction, found);
  if (HWY_UNLIKELY(!hn::AllFalse(d, active))) {
    const V nowhere = hn::Set(d, std::numeric_limits<T>::max());
    return with_long_walks(d, lattice, eye, direction, t_max, active, nowhere, nowhere,
                           CellHit<V, M>(found));
  }
  return found;
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
