// Packets against squares of touching spheres, and the shadows of those.

#if defined(RAYTRACER_KERNEL_SIMD_SQUARE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_SQUARE_INL_H_
#undef RAYTRACER_KERNEL_SIMD_SQUARE_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_SQUARE_INL_H_
#endif

#include <limits>

#include "engine/kernel/simd/hit-inl.h"
#include "engine/kernel/simd/simd_scene.h"
#include "engine/kernel/simd/square_rows-inl.h"
#include "engine/kernel/simd/square_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// Whether a neighbour in the stencil's cell stands between a sphere's point with `normal` and a
/// distant light, both in the square's axes.
///
/// With the point n/2, the neighbour's centre o in cells and the light's direction d, the line
/// passes at the centre's height after b = o.d - n.d/2, and its squared distance there is
/// |o - n/2|^2 - b^2 = 1/4 + (|o|^2 - o.n) - b^2.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M stands_before(D d, const StencilCell<T>& cell, const V3<V>& normal, V half_incidence) {
  const V b = hn::Sub(hn::Set(d, cell.forward), half_incidence);
  const V beyond =
      hn::NegMulAdd(normal.x, hn::Set(d, cell.first),
                    hn::NegMulAdd(normal.z, hn::Set(d, cell.second), hn::Set(d, cell.distance2)));
  return hn::And(hn::Ge(hn::Mul(b, b), beyond), hn::Gt(b, hn::Zero(d)));
}

/// Whether a neighbour of a sphere that has them all stands between its point with `normal` and a
/// distant light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M shadowed_amid(D d, const Stencil<T>& stencil, const V3<V>& normal, V incidence) {
  const V half_incidence = hn::Mul(hn::Set(d, T(0.5)), incidence);
  M shadowed = hn::Lt(incidence, incidence);
  for (const StencilCell<T>& cell : stencil.cells)
    shadowed = hn::Or(shadowed, stands_before(d, cell, normal, half_incidence));
  return shadowed;
}

/// The same for the sphere in cell (first, second), wherever that is.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M shadowed_by_neighbours(D d, const SimdSquare<T>& square, const Stencil<T>& stencil,
                                    V first, V second, const V3<V>& normal, V incidence, M active) {
  const auto within = [&](V place, T low, T high, T reach) HWY_ATTR {
    return hn::And(hn::Ge(place, hn::Set(d, low + reach)), hn::Le(place, hn::Set(d, high - reach)));
  };
  const M amid = hn::And(within(first, square.low_first, square.high_first, stencil.reach),
                         within(second, square.low_second, square.high_second, stencil.reach));
  if (hn::AllTrue(d, hn::Or(amid, hn::Not(active))))
    return hn::And(active, shadowed_amid(d, stencil, normal, incidence));
  const V half_incidence = hn::Mul(hn::Set(d, T(0.5)), incidence);
  M shadowed = hn::Lt(incidence, incidence);
  for (const StencilCell<T>& cell : stencil.cells) {
    const M is_there = hn::And(
        within(hn::Add(first, hn::Set(d, cell.first)), square.low_first, square.high_first, T(0)),
        within(hn::Add(second, hn::Set(d, cell.second)), square.low_second, square.high_second,
               T(0)));
    shadowed = hn::Or(shadowed, hn::And(stands_before(d, cell, normal, half_incidence), is_there));
  }
  return hn::And(shadowed, active);
}

/// The packet against the squares.
template <bool leaves_cell, class D, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE void show_squares(D d, const SimdScene<T>& scene, const Start<V>& from,
                             const V3<V>& direction, M active, Nearest<V>& nearest) {
  // In registers: what a function out of line is told of stays in memory.
  V nearest_t = nearest.t;
  V nearest_id = nearest.id;
  V first = nearest.first;
  V second = nearest.second;
  V3<V> normal = nearest.normal;
  bool is_first_square = true;
  for (const SimdSquare<T>& square : scene.squares) {
    const V to_cells = hn::Set(d, square.cells_per_unit);
    const V3<V> eye = broadcast(d, square.eye);
    const V3<V> slope = along_square(square, direction);
    const V t_max = hn::Mul(nearest_t, to_cells);
    const V id = hn::Set(d, square.id);
    CellHit<V, M> found;
    if (!leaves_cell && is_outside_slab(square)) {
      found = first_in_rows(d, square, slope, t_max, active);
    } else {
      const V3<V> origin =
          leaves_cell ? mul_add(along_square(square, from.point), to_cells, eye) : eye;
      const M leaves = hn::Eq(from.id, id);
      const V nowhere = hn::Set(d, std::numeric_limits<T>::max());
      found = walk_square<leaves_cell>(d, square, origin, slope, t_max, active,
                                       hn::IfThenElse(leaves, from.first, nowhere),
                                       hn::IfThenElse(leaves, from.second, nowhere));
    }
    const V t = hn::Mul(found.t, hn::Set(d, square.unit_per_cell));
    const M nearer = is_nearer(nearest_t, nearest_id, t, id, found.hit);
    nearest_t = hn::IfThenElse(nearer, t, nearest_t);
    nearest_id = hn::IfThenElse(nearer, id, nearest_id);
    const V3<V> found_normal = from_square(square, found.normal);
    if (is_first_square) {  // of no lane that met something else does it matter
      first = found.first;
      second = found.second;
      normal = found_normal;
    } else {
      first = hn::IfThenElse(nearer, found.first, first);
      second = hn::IfThenElse(nearer, found.second, second);
      normal = select(nearer, found_normal, normal);
    }
    is_first_square = false;
  }
  nearest.t = nearest_t;
  nearest.id = nearest_id;
  nearest.first = first;
  nearest.second = second;
  nearest.normal = normal;
}

/// Lanes of `lit` from which a sphere of a square stands before the light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_by_square(D d, const SimdSquare<T>& square, const Stencil<T>& stencil,
                                const Start<V>& from, const V3<V>& towards, V distance, V incidence,
                                M lit) {
  const M leaves = hn::Eq(from.id, hn::Set(d, square.id));
  M dark = hn::Lt(distance, hn::Zero(d));
  if (stencil.suffices) {
    const M neighbours = hn::And(lit, leaves);
    if (!hn::AllFalse(d, neighbours))
      dark = shadowed_by_neighbours(d, square, stencil, from.first, from.second,
                                    along_square(square, from.normal), incidence, neighbours);
    lit = hn::AndNot(leaves, lit);
  }
  if (hn::AllFalse(d, lit)) return dark;
  const V to_cells = hn::Set(d, square.cells_per_unit);
  const V3<V> origin =
      mul_add(along_square(square, from.point), to_cells, broadcast(d, square.eye));
  const V nowhere = hn::Set(d, std::numeric_limits<T>::max());
  const CellHit<V, M> found = walk_square<true>(
      d, square, origin, along_square(square, towards), hn::Mul(distance, to_cells), lit,
      hn::IfThenElse(leaves, from.first, nowhere), hn::IfThenElse(leaves, from.second, nowhere));
  const M before = hn::Lt(found.t, hn::Mul(distance, to_cells));
  return hn::Or(dark, hn::And(found.hit, before));
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
