// A packet's shadow rays to a distant light, by the grid on the plane across it.

#include "engine/finders/light_grid.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Points as the light sees them: `u` and `v` across its direction, `w` towards it.
template <class V>
struct LightPlaces {
  V u;
  V v;
  V w;
};

template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE LightPlaces<V> places_on(D d, const LightPlane<T>& plane, const V3<V>& point) {
  return {dot(point, broadcast(d, plane.axes[0])), dot(point, broadcast(d, plane.axes[1])),
          dot(point, broadcast(d, plane.axes[2]))};
}

/// A coordinate in cells, as it is across columns or rows.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V in_cells(D d, const LightPlane<T>& plane, V coordinate, T low) {
  return hn::Mul(hn::Sub(coordinate, hn::Set(d, low)), hn::Set(d, plane.cells_per_unit));
}

/// The cells that hold the points.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V cell_of(D d, const LightPlane<T>& plane, const LightPlaces<V>& at) {
  return hn::MulAdd(hn::Floor(in_cells(d, plane, at.v, plane.v_low)),
                    hn::Set(d, static_cast<T>(plane.columns)),
                    hn::Floor(in_cells(d, plane, at.u, plane.u_low)));
}

/// Lanes whose points are on the plane's cells: beside them nothing stands before the light but
/// what is set aside.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M is_on_plane(D d, const LightPlane<T>& plane, const LightPlaces<V>& at) {
  const auto is_within = [&](V place, int count) HWY_ATTR {
    return hn::And(hn::Ge(place, hn::Zero(d)), hn::Lt(place, hn::Set(d, static_cast<T>(count))));
  };
  return hn::And(is_within(in_cells(d, plane, at.u, plane.u_low), plane.columns),
                 is_within(in_cells(d, plane, at.v, plane.v_low), plane.rows));
}

/// Lanes of `lit` that a caster of the grid hides from the light, as occluded_in_cells() has it.
template <class D, class Grid, class Test, class V, std::size_t size, class M = hn::Mask<D>>
HWY_INLINE M occluded_by_casters(D d, const Grid& grid, const LightPlaces<V>& at, const Test& test,
                                 const V (&values)[size], M lit) {
  const M dark = occluded_in_cells(d, grid, cell_of(d, grid.plane, at), test, values,
                                   hn::And(lit, is_on_plane(d, grid.plane, at)));
  if (HWY_LIKELY(grid.wide.count == 0)) return dark;
  return hn::Or(dark, occluded_by_wide(d, grid, test, values, hn::AndNot(dark, lit)));
}

/// Lanes of `lit` that something that the grid lists hides from the light, as occluded_in_lists()
/// has it.
template <class D, class Hides, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE M occluded_by_listed(D d, const ListGrid<T>& grid, const LightPlaces<V>& at, M lit,
                                const Hides& hides) {
  const LightPlane<T>& plane = grid.plane;
  const V part =
      part_at(d, in_cells(d, plane, at.u, plane.u_low), in_cells(d, plane, at.v, plane.v_low));
  const M dark = occluded_in_lists(d, grid.cells, ListPlaces<V>{cell_of(d, plane, at), part}, at.w,
                                   hn::And(lit, is_on_plane(d, plane, at)), hides);
  if (HWY_LIKELY(grid.cells.wide.count == 0)) return dark;
  return hn::Or(dark, occluded_by_wide(d, grid.cells, hn::AndNot(dark, lit), hides));
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
