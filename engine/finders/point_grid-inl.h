// A packet's shadow rays to a point light, by the cells of the cube around the light.

#include <limits>

#include "engine/finders/point_grid.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Where points are seen from a light: in cells, from a face's first.
template <class V>
struct CubePlaces {
  V face;
  V column;
  V row;
};

/// Where the points are seen, for the lanes of `lit`, at least one. Takes those out of `lit` that
/// are seen where nothing else is but what is set aside.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE CubePlaces<V> places_around(D d, const LightCube<T>& cube, const Triple<T>& light,
                                       const V3<V>& point, M& lit) {
  const V zero = hn::Zero(d);
  const V3<V> out = sub(point, broadcast(d, light));
  const V3<V> size{hn::Abs(out.x), hn::Abs(out.y), hn::Abs(out.z)};
  const M is_x = hn::And(hn::Ge(size.x, size.y), hn::Ge(size.x, size.z));
  const M is_y = hn::Ge(size.y, size.z);
  const auto pick = [&](V x, V y, V z)
                        HWY_ATTR { return hn::IfThenElse(is_x, x, hn::IfThenElse(is_y, y, z)); };
  const V along = pick(out.x, out.y, out.z);
  const V cells_per_unit = hn::Div(hn::Set(d, cube.cells_per_unit), hn::Abs(along));
  const V axis = pick(zero, hn::Set(d, T(2)), hn::Set(d, T(4)));
  const V face = hn::IfThenElse(hn::Lt(along, zero), hn::Add(axis, hn::Set(d, T(1))), axis);
  using Face = CubeFace<T>;
  const Rows<D, Face> begin(d, cube.faces.data(), face, lit);
  V3<V> at = out;
  V w = along;
  if (HWY_UNLIKELY(cube.is_far)) {
    at = point;
    w = pick(point.x, point.y, point.z);
  }
  const auto in_cells = [&](V across, T Face::*slope, T Face::*start) HWY_ATTR {
    const V beyond = hn::Sub(hn::NegMulAdd(begin(d, slope), w, across), begin(d, start));
    return hn::Mul(beyond, cells_per_unit);
  };
  const V column = in_cells(pick(at.y, at.z, at.x), &Face::u_slope, &Face::u_start);
  const V row = in_cells(pick(at.z, at.x, at.y), &Face::v_slope, &Face::v_start);
  const V side = hn::Set(d, static_cast<T>(cube.side));
  const V least = hn::Min(column, row);
  const V most = hn::Max(column, row);
  lit = hn::And(lit, hn::And(hn::Ge(least, zero), hn::Lt(most, side)));
  return {face, column, row};
}

/// The cells of the light's cube that hold them.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V cell_of(D d, const LightCube<T>& cube, const CubePlaces<V>& at) {
  const V side = hn::Set(d, static_cast<T>(cube.side));
  return hn::MulAdd(hn::MulAdd(at.face, side, hn::Floor(at.row)), side, hn::Floor(at.column));
}

/// Lanes of `lit` that a caster around the light hides from it, as occluded_in_cells() has it.
template <class D, class Grid, class Test, class V, std::size_t size, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE M occluded_by_casters(D d, const Grid& grid, const Triple<T>& light, const V3<V>& point,
                                 const Test& test, const V (&values)[size], M lit) {
  if (hn::AllFalse(d, lit)) return lit;
  M in_sight = lit;
  const V cell = cell_of(d, grid.cube, places_around(d, grid.cube, light, point, in_sight));
  const M dark = occluded_in_cells(d, grid, cell, test, values, in_sight);
  if (HWY_LIKELY(grid.wide.count == 0)) return dark;
  return hn::Or(dark, occluded_by_wide(d, grid, test, values, hn::AndNot(dark, lit)));
}

/// Lanes of `lit` that something that is listed around the light hides from it, as
/// occluded_in_lists() has it.
template <class D, class Hides, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE M occluded_by_listed(D d, const PointLists<T>& lists, const Triple<T>& light,
                                const ShadowRays<V>& rays, M lit, const Hides& hides) {
  if (hn::AllFalse(d, lit)) return lit;
  M in_sight = lit;
  const CubePlaces<V> at = places_around(d, lists.cube, light, rays.from.point, in_sight);
  const ListPlaces<V> places{cell_of(d, lists.cube, at), part_at(d, at.column, at.row)};
  const M dark = occluded_in_lists(d, lists.cells, places, hn::Neg(rays.path), in_sight, hides);
  if (HWY_LIKELY(lists.cells.wide.count == 0)) return dark;
  return hn::Or(dark, occluded_by_wide(d, lists.cells, hn::AndNot(dark, lit), hides));
}

/// Rays from a point light to where shadow rays to it begin.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
struct LampRays {
  V3<V> direction;
  V path;
  V incidence;  ///< as ShadowRays has it
  V noise;      ///< what their ends may be off by

  HWY_INLINE LampRays(D d, const ShadowRays<V>& rays)
      : direction(negate(rays.towards)), path(rays.path), incidence(rays.incidence) {
    const V3<V>& point = rays.from.point;
    const V size = hn::Add(hn::Add(hn::Abs(point.x), hn::Abs(point.y)), hn::Abs(point.z));
    noise = hn::Mul(hn::Set(d, 8 * std::numeric_limits<T>::epsilon()), hn::Add(size, path));
  }

  /// Lanes that are within a convex solid somewhere between their ends, if they enter and leave it
  /// there. None but the light is inside of one.
  HWY_INLINE hn::Mask<D> pass(D d, V enter, V leave) const {
    return hn::And(hn::Gt(leave, hn::Zero(d)), hn::Lt(hn::Add(enter, leave), hn::Add(path, path)));
  }
  /// Lanes that meet a surface at t before the one that they end on, of whose tangent plane that is
  /// well before.
  HWY_INLINE hn::Mask<D> meet(D d, V t) const {
    return hn::And(hn::Gt(t, hn::Zero(d)), hn::Gt(hn::Mul(hn::Sub(path, t), incidence), noise));
  }
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
