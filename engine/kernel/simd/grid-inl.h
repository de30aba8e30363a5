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

/// Lanes of `lit` from which a sphere of the grid stands before its distant light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_in_grid(D d, const DistantGrid<T>& grid, const Start<V>& from, M lit) {
  const GridPlaces<V, M> at = places_on(d, grid, from.point);
  const V cell = hn::MulAdd(at.row, hn::Set(d, static_cast<T>(grid.columns)), at.column);
  constexpr std::size_t most_lanes = hn::MaxLanes(D());
  HWY_ALIGN T us[most_lanes];
  HWY_ALIGN T vs[most_lanes];
  HWY_ALIGN T ws[most_lanes];
  HWY_ALIGN T ids[most_lanes];
  hn::Store(at.u, d, us);
  hn::Store(at.v, d, vs);
  hn::Store(at.w, d, ws);
  hn::Store(from.id, d, ids);
  M dark = hn::Lt(cell, cell);
  const auto test_together = [&](std::size_t begin, std::size_t end, M lanes) HWY_ATTR {
    for (std::size_t i = begin; i < end; ++i) {
      const V du = hn::Sub(hn::Set(d, grid.u[i]), at.u);
      const V dv = hn::Sub(hn::Set(d, grid.v[i]), at.v);
      const M meets = hn::Le(hn::MulAdd(du, du, hn::Mul(dv, dv)), hn::Set(d, grid.radius2[i]));
      const M before =
          hn::And(hn::Gt(hn::Set(d, grid.w[i]), at.w), hn::Ne(hn::Set(d, grid.id[i]), from.id));
      dark = hn::Or(dark, hn::And(lanes, hn::And(meets, before)));
    }
  };
  const auto test_alone = [&](std::size_t begin, std::size_t end, std::size_t lane,
                              M alone) HWY_ATTR {
    const V point_u = hn::Set(d, us[lane]);
    const V point_v = hn::Set(d, vs[lane]);
    const V point_w = hn::Set(d, ws[lane]);
    const V own = hn::Set(d, ids[lane]);
    const bool is_sorted = end - begin > DistantGrid<T>::few;
    for (std::size_t i = begin; i < end; i += most_lanes) {
      // Then this one and all behind it are farther from the light.
      if (is_sorted && grid.w[i] <= ws[lane]) break;
      const V du = hn::Sub(hn::LoadU(d, &grid.u[i]), point_u);
      const V dv = hn::Sub(hn::LoadU(d, &grid.v[i]), point_v);
      const V distance2 = hn::MulAdd(du, du, hn::Mul(dv, dv));
      const M before = hn::And(hn::Gt(hn::LoadU(d, &grid.w[i]), point_w),
                               hn::Ne(hn::LoadU(d, &grid.id[i]), own));
      const M meets =
          hn::And(hn::Le(distance2, hn::LoadU(d, &grid.radius2[i])), hn::FirstN(d, end - i));
      if (!hn::AllFalse(d, hn::And(before, meets))) {
        dark = hn::Or(dark, alone);
        break;
      }
    }
  };
  // Off the grid nothing stands before the light.
  for_each_cell(d, grid.begins, cell, hn::And(lit, at.is_on_grid), test_together, test_alone);
  return dark;
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
