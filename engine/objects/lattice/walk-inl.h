// Packets against a lattice of touching spheres: a walk over its cells.
//
// A sphere touches the four sides of its cell, so a ray can meet it only while above or below
// that cell, and the first sphere met on the way is the nearest. Positions are recomputed from
// the cells' integer coordinates, never accumulated.

#include <limits>

#include "engine/objects/lattice/long_walk.h"
#include "engine/objects/lattice/packets.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// A vector's coordinates along the lattice's first axis, across it, and along its second.
template <typename T, class V>
HWY_INLINE V3<V> along_lattice(const LatticeItem<T>& lattice, const V3<V>& v) {
  // One vector after another: g++ keeps a choice between structures of them in memory.
  V first = v.x;
  V across = v.y;
  V second = v.z;
  if (lattice.axes[1] == 2) {
    across = v.z;
    second = v.y;
  } else if (lattice.axes[1] == 0) {
    first = v.y;
    across = v.x;
  }
  return {first, across, second};
}

/// The inverse of along_lattice, which exchanges at most two coordinates.
template <typename T, class V>
HWY_INLINE V3<V> from_lattice(const LatticeItem<T>& lattice, const V3<V>& v) {
  return along_lattice(lattice, v);
}

/// Where a packet met a lattice: distance and position in cells, the normal in the lattice's axes.
template <class V, class M>
struct CellHit {
  M hit;
  V t;
  V first;
  V second;
  V3<V> normal;
};

/// How rays pass the spheres in some cells.
template <class V>
struct CellPass {
  V3<V> from_center;
  V middle;      ///< the distance to the middle of the way through the sphere
  V3<V> radius;  ///< from the sphere's centre to there
  V half;        ///< of the way through it; 0 of rays that miss it
};

template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE CellPass<V> pass_of(D d, const V3<V>& origin, const V3<V>& direction, V first,
                               V second) {
  const V3<V> f{hn::Sub(origin.x, first), origin.y, hn::Sub(origin.z, second)};
  const V middle = hn::Neg(dot(f, direction));
  const V3<V> radius = mul_add(direction, middle, f);
  const V room = hn::Sub(hn::Set(d, T(0.25)), dot(radius, radius));
  return {f, middle, radius, hn::Sqrt(hn::Max(room, hn::Zero(d)))};
}

/// Notes that lanes meet their spheres at t, as far from the middle as `beyond` says.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void meet_cell(D d, const CellPass<V>& pass, const V3<V>& direction, V t, V beyond,
                          CellHit<V, M>& found) {
  found.t = t;
  const V3<V> radius = mul_add(direction, beyond, pass.radius);
  // To a length of 1, which a highlight's power demands, by a step of Newton's method from 1/2.
  const V lengthen = hn::NegMulAdd(hn::Set(d, T(4)), dot(radius, radius), hn::Set(d, T(3)));
  found.normal = scale(radius, lengthen);
}

/// Notes the distance to the sphere that was found, in the residual form of sphere_terms(), so
/// that it is as far as the same one that is in no lattice, and its normal.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void measure(D d, const V3<V>& origin, const V3<V>& direction, CellHit<V, M>& found) {
  const CellPass<V> pass = pass_of(d, origin, direction, found.first, found.second);
  const V3<V>& f = pass.from_center;
  const V c = hn::Max(hn::Sub(dot(f, f), hn::Set(d, T(0.25))), hn::Zero(d));
  meet_cell(d, pass, direction, hn::Div(c, hn::Add(pass.middle, pass.half)), hn::Neg(pass.half),
            found);
}

/// The same of rays inside of that sphere: where they leave it.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void measure_way_out(D d, const V3<V>& origin, const V3<V>& direction,
                                CellHit<V, M>& found) {
  const CellPass<V> pass = pass_of(d, origin, direction, found.first, found.second);
  meet_cell(d, pass, direction, hn::Add(pass.middle, pass.half), pass.half, found);
}

/// Steps before a walk is finished by the reference, far more than a ray takes that comes from
/// above and is not level.
inline constexpr int most_steps = 512;

/// What was found, once the walks of the lanes still active are finished, one by one.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
[[gnu::cold]] HWY_NOINLINE CellHit<V, M> with_long_walks(D d, const LatticeItem<T>& lattice,
                                                         const V3<V>& origin,
                                                         const V3<V>& direction, V t_max, M active,
                                                         V own_first, V own_second,
                                                         const CellHit<V, M>& found) {
  constexpr std::size_t most_lanes = hn::MaxLanes(D());
  // The lanes' values: origin, direction, limit, own cell, whether to finish, then the results.
  alignas(64) T values[13][most_lanes];
  const V one = hn::Set(d, T(1));
  const V inputs[10] = {
      origin.x,    origin.y, origin.z,  direction.x, direction.y,
      direction.z, t_max,    own_first, own_second,  hn::IfThenElseZero(active, one)};
  for (std::size_t i = 0; i < 10; ++i) hn::Store(inputs[i], d, values[i]);
  hn::Store(found.t, d, values[10]);
  hn::Store(found.first, d, values[11]);
  hn::Store(found.second, d, values[12]);
  alignas(64) T is_hit[most_lanes] = {};
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    if (values[9][lane] == T(0)) continue;
    const auto at = [&](int row) { return static_cast<double>(values[row][lane]); };
    const bool leaves = values[7][lane] < std::numeric_limits<T>::max();
    const auto hit = finish_walk({.origin = {at(0), at(1), at(2)},
                                  .direction = {at(3), at(4), at(5)},
                                  .low_first = static_cast<double>(lattice.low_first),
                                  .low_second = static_cast<double>(lattice.low_second),
                                  .side = static_cast<double>(lattice.high_first) -
                                          static_cast<double>(lattice.low_first) + 1,
                                  .own_first = at(7),
                                  .own_second = at(8),
                                  .leaves_own = leaves});
    if (!hit || hit->t > at(6)) continue;
    is_hit[lane] = T(1);
    values[10][lane] = static_cast<T>(hit->t);
    values[11][lane] = static_cast<T>(hit->first);
    values[12][lane] = static_cast<T>(hit->second);
  }
  const M finished = hn::Gt(hn::Load(d, is_hit), hn::Zero(d));
  const V t = hn::Load(d, values[10]);
  const V first = hn::Load(d, values[11]);
  const V second = hn::Load(d, values[12]);
  const V3<V> point = mul_add(direction, t, origin);
  const V3<V> radius{hn::Sub(point.x, first), point.y, hn::Sub(point.z, second)};
  return {hn::Or(found.hit, finished), t, first, second,
          select(finished, unit(d, radius), found.normal)};
}

/// The nearest sphere met at 0 < t <= t_max (in cells), for the lanes of `active`.
/// `origin` and `direction` are in the lattice's axes and cells. With `leaves_cell` the sphere in
/// the cell (own_first, own_second) is one that the ray leaves, and not met.
template <bool leaves_cell, class D, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE CellHit<V, M> walk_lattice(D d, const LatticeItem<T>& lattice, const V3<V>& origin,
                                      const V3<V>& direction, V t_max, M active, V own_first,
                                      V own_second) {
  const V zero = hn::Zero(d);
  const V half = hn::Set(d, T(0.5));
  const V one = hn::Set(d, T(1));
  const V quarter = hn::Set(d, T(0.25));
  const V low_first = hn::Set(d, lattice.low_first);
  const V high_first = hn::Set(d, lattice.high_first);
  const V low_second = hn::Set(d, lattice.low_second);
  const V high_second = hn::Set(d, lattice.high_second);

  const V inverse_first = inverse(d, without_zero(d, direction.x));
  const V inverse_across = inverse(d, without_zero(d, direction.y));
  const V inverse_second = inverse(d, without_zero(d, direction.z));

  V t_begin = zero;
  V t_end = t_max;
  const auto clip = [&](V low, V high, V from, V slope_inverse) HWY_ATTR {
    const V t1 = hn::Mul(hn::Sub(low, from), slope_inverse);
    const V t2 = hn::Mul(hn::Sub(high, from), slope_inverse);
    t_begin = hn::Max(t_begin, hn::Min(t1, t2));
    t_end = hn::Min(t_end, hn::Max(t1, t2));
  };
  clip(hn::Neg(half), half, origin.y, inverse_across);
  clip(hn::Sub(low_first, half), hn::Add(high_first, half), origin.x, inverse_first);
  clip(hn::Sub(low_second, half), hn::Add(high_second, half), origin.z, inverse_second);
  active = hn::And(active, hn::Le(t_begin, t_end));
  CellHit<V, M> found{hn::Lt(zero, zero), t_max, zero, zero, {zero, zero, zero}};
  if (hn::AllFalse(d, active)) return found;

  const V step_first = hn::CopySign(one, direction.x);
  const V step_second = hn::CopySign(one, direction.z);
  const auto start = [&](V from, V slope, V low, V high) HWY_ATTR {
    return hn::Min(hn::Max(hn::Round(hn::MulAdd(t_begin, slope, from)), low), high);
  };
  V first = start(origin.x, direction.x, low_first, high_first);
  V second = start(origin.z, direction.z, low_second, high_second);
  // The ray leaves cell i at i * inverse + leave.
  const auto leave_time = [&](V step, V from, V slope_inverse) HWY_ATTR {
    return hn::Mul(hn::Sub(hn::Mul(half, step), from), slope_inverse);
  };
  const V leave_first = leave_time(step_first, origin.x, inverse_first);
  const V leave_second = leave_time(step_second, origin.z, inverse_second);

  // With f from the sphere in the lane's cell to the origin, the line passes it at |f x d|^2, and
  // ahead if f.d < 0. The walk goes on whatever it meets: a step need not wait for the test before.
  const V across = hn::Mul(origin.y, direction.y);
  const V across_first = hn::Mul(origin.y, direction.x);
  const V across_second = hn::Mul(origin.y, direction.z);
  for (int step = 0; !hn::AllFalse(d, active) && step < most_steps; ++step) {
    const V f_first = hn::Sub(origin.x, first);
    const V f_second = hn::Sub(origin.z, second);
    const V behind = hn::MulAdd(f_first, direction.x, hn::MulAdd(f_second, direction.z, across));
    const V3<V> moment{hn::NegMulAdd(f_second, direction.y, across_second),
                       hn::MulSub(f_first, direction.y, across_first),
                       hn::MulSub(f_second, direction.x, hn::Mul(f_first, direction.z))};
    M is_hit = hn::And(hn::And(active, hn::Lt(behind, zero)), hn::Le(dot(moment, moment), quarter));
    if constexpr (leaves_cell)
      is_hit = hn::AndNot(hn::And(hn::Eq(first, own_first), hn::Eq(second, own_second)), is_hit);
    found.hit = hn::Or(found.hit, is_hit);
    found.first = hn::IfThenElse(is_hit, first, found.first);
    found.second = hn::IfThenElse(is_hit, second, found.second);

    const V t_first = hn::MulAdd(first, inverse_first, leave_first);
    const V t_second = hn::MulAdd(second, inverse_second, leave_second);
    const M crosses_first = hn::Lt(t_first, t_second);
    active = hn::And(hn::AndNot(is_hit, active), hn::Le(hn::Min(t_first, t_second), t_end));
    first = hn::IfThenElse(crosses_first, hn::Add(first, step_first), first);
    second = hn::IfThenElse(crosses_first, second, hn::Add(second, step_second));
  }

  measure(d, origin, direction, found);
  // A rounding of t_end may let a walk end a cell beyond the lattice's.
  const M in_lattice =
      hn::And(hn::And(hn::Ge(found.first, low_first), hn::Le(found.first, high_first)),
              hn::And(hn::Ge(found.second, low_second), hn::Le(found.second, high_second)));
  found.hit = hn::And(hn::And(found.hit, in_lattice), hn::Le(found.t, t_max));
  if (HWY_UNLIKELY(!hn::AllFalse(d, active)))
    return with_long_walks(d, lattice, origin, direction, t_max, active, own_first, own_second,
                           CellHit<V, M>(found));
  return found;
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
