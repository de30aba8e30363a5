// A packet's shadow rays to a distant light, by the light's grid.

#if defined(RAYTRACER_KERNEL_SIMD_GRID_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_GRID_INL_H_
#undef RAYTRACER_KERNEL_SIMD_GRID_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_GRID_INL_H_
#endif

#include "engine/kernel/simd/cells-inl.h"
#include "engine/kernel/simd/hit-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// The cells that hold the points.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V cell_of(D d, const DistantGrid<T>& grid, const GridPlaces<V, hn::Mask<D>>& at) {
  return hn::MulAdd(at.row, hn::Set(d, static_cast<T>(grid.columns)), at.column);
}

/// fetch_cells() for the grid's discs at the points of `lanes`.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void fetch_grid_cells(D d, const DistantGrid<T>& grid, const V3<V>& points, M lanes) {
  const GridPlaces<V, M> at = places_on(d, grid, points);
  fetch_cells(d, grid, grid.discs, cell_of(d, grid, at), hn::And(lanes, at.is_on_grid));
}

/// Lanes of `lit` from which a sphere of the grid stands before its distant light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_in_grid(D d, const DistantGrid<T>& grid, const Start<V>& from, M lit) {
  const GridPlaces<V, M> at = places_on(d, grid, from.point);
  const V cell = cell_of(d, grid, at);
  constexpr std::size_t most_lanes = hn::MaxLanes(D());
  HWY_ALIGN T us[most_lanes];
  HWY_ALIGN T vs[most_lanes];
  HWY_ALIGN T ws[most_lanes];
  HWY_ALIGN T ids[most_lanes];
  hn::Store(at.u, d, us);
  hn::Store(at.v, d, vs);
  hn::Store(at.w, d, ws);
  hn::Store(from.id, d, ids);
  using Grid = DistantGrid<T>;
  M dark = hn::Lt(cell, cell);
  std::uint64_t dark_alone = 0;
  const auto test_together = [&](std::size_t begin, std::size_t end, M lanes) HWY_ATTR {
    const T* const values = grid.discs.cell(begin);
    const std::size_t count = end - begin;
    for (std::size_t i = 0; i < count; ++i) {
      const auto all = [&](typename Grid::Column column)
                           HWY_ATTR { return hn::Set(d, values[column * count + i]); };
      const V du = hn::Sub(all(Grid::u), at.u);
      const V dv = hn::Sub(all(Grid::v), at.v);
      const M meets = hn::Le(hn::MulAdd(du, du, hn::Mul(dv, dv)), all(Grid::radius2));
      const M before = hn::And(hn::Gt(all(Grid::w), at.w), hn::Ne(all(Grid::id), from.id));
      dark = hn::Or(dark, hn::And(lanes, hn::And(meets, before)));
    }
  };
  const auto test_alone = [&](std::size_t begin, std::size_t end, std::size_t lane) HWY_ATTR {
    const T* const values = grid.discs.cell(begin);
    const std::size_t count = end - begin;
    const V point_u = hn::Set(d, us[lane]);
    const V point_v = hn::Set(d, vs[lane]);
    const V point_w = hn::Set(d, ws[lane]);
    const V own = hn::Set(d, ids[lane]);
    const bool is_sorted = count > Grid::few;
    for (std::size_t i = 0; i < count; i += most_lanes) {
      const auto next = [&](typename Grid::Column column)
                            HWY_ATTR { return hn::LoadU(d, values + column * count + i); };
      // Then this one and all behind it are farther from the light.
      if (is_sorted && values[Grid::w * count + i] <= ws[lane]) break;
      const V du = hn::Sub(next(Grid::u), point_u);
      const V dv = hn::Sub(next(Grid::v), point_v);
      const V distance2 = hn::MulAdd(du, du, hn::Mul(dv, dv));
      const M before = hn::And(hn::Gt(next(Grid::w), point_w), hn::Ne(next(Grid::id), own));
      const M meets = hn::And(hn::Le(distance2, next(Grid::radius2)), hn::FirstN(d, count - i));
      if (!hn::AllFalse(d, hn::And(before, meets))) {
        dark_alone |= std::uint64_t{1} << lane;
        break;
      }
    }
  };
  // Off the grid nothing stands before the light.
  for_each_cell(d, grid.begins, cell, hn::And(lit, at.is_on_grid), test_together, test_alone);
  return hn::And(lit, hn::Or(dark, mask_of(d, dark_alone)));
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
