// Packets against a square of touching spheres: a walk over its cells.
//
// A sphere touches the four sides of its cell, so a ray can meet it only while above or below
// that cell, and the first sphere met on the way is the nearest. Positions are recomputed from
// the cells' integer coordinates, never accumulated.

#if defined(RAYTRACER_KERNEL_SIMD_SQUARE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_SQUARE_INL_H_
#undef RAYTRACER_KERNEL_SIMD_SQUARE_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_SQUARE_INL_H_
#endif

#include <limits>

#include "engine/kernel/simd/long_walk.h"
#include "engine/kernel/simd/packet-inl.h"
#include "engine/kernel/simd/simd_scene.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// A vector's coordinates along the square's first axis, across it, and along its second.
template <typename T, class V>
HWY_INLINE V3<V> along_square(const SimdSquare<T>& square, const V3<V>& v) {
  if (square.axes[1] == 1) return v;
  return square.axes[1] == 2 ? V3<V>{v.x, v.z, v.y} : V3<V>{v.y, v.x, v.z};
}

/// The inverse of along_square, which exchanges at most two coordinates.
template <typename T, class V>
HWY_INLINE V3<V> from_square(const SimdSquare<T>& square, const V3<V>& v) {
  return along_square(square, v);
}

/// Where a packet met a square: distance and position in cells.
template <class V, class M>
struct CellHit {
  M hit;
  V t;
  V first;
  V second;
};

/// Steps before a walk is finished by the reference, far more than a ray takes that comes from
/// above and is not level.
inline constexpr int most_steps = 512;

/// Finishes the walks of the lanes still active, one by one.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE void finish_long_walks(D d, const SimdSquare<T>& square, const V3<V>& origin,
                                    const V3<V>& direction, V t_max, M active, V own_first,
                                    V own_second, CellHit<V, M>& found) {
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
    const auto hit = finish_walk(
        {.origin = {at(0), at(1), at(2)},
         .direction = {at(3), at(4), at(5)},
         .low_first = static_cast<double>(square.low_first),
         .low_second = static_cast<double>(square.low_second),
         .side = static_cast<double>(square.high_first) - static_cast<double>(square.low_first) + 1,
         .own_first = at(7),
         .own_second = at(8),
         .leaves_own = leaves});
    if (!hit || hit->t > at(6)) continue;
    is_hit[lane] = T(1);
    values[10][lane] = static_cast<T>(hit->t);
    values[11][lane] = static_cast<T>(hit->first);
    values[12][lane] = static_cast<T>(hit->second);
  }
  found.hit = hn::Or(found.hit, hn::Gt(hn::Load(d, is_hit), hn::Zero(d)));
  found.t = hn::Load(d, values[10]);
  found.first = hn::Load(d, values[11]);
  found.second = hn::Load(d, values[12]);
}

/// The nearest sphere met at 0 < t <= t_max (in cells), for the lanes of `active`.
/// `origin` and `direction` are in the square's axes and cells; the sphere in the cell
/// (own_first, own_second) is the one that the ray leaves.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE CellHit<V, M> walk_square(D d, const SimdSquare<T>& square, const V3<V>& origin,
                                     const V3<V>& direction, V t_max, M active, V own_first,
                                     V own_second) {
  const V zero = hn::Zero(d);
  const V half = hn::Set(d, T(0.5));
  const V one = hn::Set(d, T(1));
  const V quarter = hn::Set(d, T(0.25));
  const V low_first = hn::Set(d, square.low_first);
  const V high_first = hn::Set(d, square.high_first);
  const V low_second = hn::Set(d, square.low_second);
  const V high_second = hn::Set(d, square.high_second);

  const V inverse_first = hn::Div(one, without_zero(d, direction.x));
  const V inverse_across = hn::Div(one, without_zero(d, direction.y));
  const V inverse_second = hn::Div(one, without_zero(d, direction.z));

  V t_begin = zero;
  V t_end = t_max;
  const auto clip = [&](V low, V high, V from, V inverse) HWY_ATTR {
    const V t1 = hn::Mul(hn::Sub(low, from), inverse);
    const V t2 = hn::Mul(hn::Sub(high, from), inverse);
    t_begin = hn::Max(t_begin, hn::Min(t1, t2));
    t_end = hn::Min(t_end, hn::Max(t1, t2));
  };
  clip(hn::Neg(half), half, origin.y, inverse_across);
  clip(hn::Sub(low_first, half), hn::Add(high_first, half), origin.x, inverse_first);
  clip(hn::Sub(low_second, half), hn::Add(high_second, half), origin.z, inverse_second);
  active = hn::And(active, hn::Le(t_begin, t_end));

  const V step_first = hn::CopySign(one, direction.x);
  const V step_second = hn::CopySign(one, direction.z);
  const auto start = [&](V from, V slope, V low, V high) HWY_ATTR {
    return hn::Min(hn::Max(hn::Round(hn::MulAdd(t_begin, slope, from)), low), high);
  };
  V first = start(origin.x, direction.x, low_first, high_first);
  V second = start(origin.z, direction.z, low_second, high_second);

  CellHit<V, M> found{hn::Lt(zero, zero), t_max, zero, zero};
  for (int step = 0; !hn::AllFalse(d, active); ++step) {
    if (step == most_steps) {
      finish_long_walks(d, square, origin, direction, t_max, active, own_first, own_second, found);
      break;
    }
    const V3<V> f{hn::Sub(origin.x, first), origin.y, hn::Sub(origin.z, second)};
    const V b = hn::Neg(dot(f, direction));
    const V3<V> l = mul_add(direction, b, f);
    const V discriminant = hn::Sub(quarter, dot(l, l));
    const M is_own = hn::And(hn::Eq(first, own_first), hn::Eq(second, own_second));
    M hit = hn::And(hn::And(active, hn::Ge(discriminant, zero)), hn::Gt(b, zero));
    hit = hn::AndNot(is_own, hit);
    const V c = hn::Max(hn::Sub(dot(f, f), quarter), zero);
    const V t = hn::Div(c, hn::Add(b, hn::Sqrt(hn::Max(discriminant, zero))));
    hit = hn::And(hit, hn::Le(t, t_max));
    found.hit = hn::Or(found.hit, hit);
    found.t = hn::IfThenElse(hit, t, found.t);
    found.first = hn::IfThenElse(hit, first, found.first);
    found.second = hn::IfThenElse(hit, second, found.second);
    active = hn::AndNot(hit, active);

    const V t_first =
        hn::Mul(hn::Sub(hn::MulAdd(half, step_first, first), origin.x), inverse_first);
    const V t_second =
        hn::Mul(hn::Sub(hn::MulAdd(half, step_second, second), origin.z), inverse_second);
    const M crosses_first = hn::Lt(t_first, t_second);
    active = hn::And(active, hn::Le(hn::Min(t_first, t_second), t_end));
    first = hn::Add(first, hn::IfThenElseZero(crosses_first, step_first));
    second = hn::Add(second, hn::IfThenZeroElse(crosses_first, step_second));
    active =
        hn::And(active, hn::And(hn::And(hn::Ge(first, low_first), hn::Le(first, high_first)),
                                hn::And(hn::Ge(second, low_second), hn::Le(second, high_second))));
  }
  return found;
}

/// Whether a neighbour of the sphere in cell (first, second) stands between the point
/// center + normal / 2 on it and a distant light: all positions in cells, in the square's axes.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M shadowed_by_neighbours(D d, const SimdSquare<T>& square, const Stencil<T>& stencil,
                                    V first, V second, const V3<V>& normal, const V3<V>& towards,
                                    M active) {
  const V half = hn::Set(d, T(0.5));
  const V quarter = hn::Set(d, T(0.25));
  const V zero = hn::Zero(d);
  const V low_first = hn::Set(d, square.low_first);
  const V high_first = hn::Set(d, square.high_first);
  const V low_second = hn::Set(d, square.low_second);
  const V high_second = hn::Set(d, square.high_second);
  const V3<V> point = scale(normal, half);
  M shadowed = hn::Lt(zero, zero);
  for (const auto& offset : stencil.offsets) {
    const V offset_first = hn::Set(d, offset[0]);
    const V offset_second = hn::Set(d, offset[1]);
    const V3<V> f{hn::Sub(point.x, offset_first), point.y, hn::Sub(point.z, offset_second)};
    const V b = hn::Neg(dot(f, towards));
    const V3<V> l = mul_add(towards, b, f);
    M hit = hn::And(hn::Le(dot(l, l), quarter), hn::Gt(b, zero));
    const V cell_first = hn::Add(first, offset_first);
    const V cell_second = hn::Add(second, offset_second);
    hit = hn::And(
        hit, hn::And(hn::And(hn::Ge(cell_first, low_first), hn::Le(cell_first, high_first)),
                     hn::And(hn::Ge(cell_second, low_second), hn::Le(cell_second, high_second))));
    shadowed = hn::Or(shadowed, hit);
  }
  return hn::And(shadowed, active);
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
