// A packet's shadow rays to a distant light, by the light's grid.

#if defined(RAYTRACER_KERNEL_SIMD_GRID_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_GRID_INL_H_
#undef RAYTRACER_KERNEL_SIMD_GRID_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_GRID_INL_H_
#endif

#include "engine/kernel/simd/hit-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// Lanes of `lit` from which a sphere of the grid stands before its distant light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_in_grid(D d, const DistantGrid<T>& grid, const Start<V>& from, M lit) {
  constexpr std::size_t most_lanes = hn::MaxLanes(D());
  alignas(64) T u[most_lanes];
  alignas(64) T v[most_lanes];
  alignas(64) T w[most_lanes];
  alignas(64) T id[most_lanes];
  alignas(64) T dark[most_lanes] = {};
  const auto along = [&](const Vec3& axis) HWY_ATTR {
    return dot(from.point, broadcast(d, Triple<T>{static_cast<T>(axis.x), static_cast<T>(axis.y),
                                                  static_cast<T>(axis.z)}));
  };
  hn::Store(along(grid.axes[0]), d, u);
  hn::Store(along(grid.axes[1]), d, v);
  hn::Store(along(grid.axes[2]), d, w);
  hn::Store(from.id, d, id);
  alignas(64) T is_lit[most_lanes];
  hn::Store(hn::IfThenElseZero(lit, hn::Set(d, T(1))), d, is_lit);
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    if (is_lit[lane] == T(0)) continue;
    const T column_place = (u[lane] - grid.u_low) * grid.cells_per_unit;
    const T row_place = (v[lane] - grid.v_low) * grid.cells_per_unit;
    // Off the grid nothing stands before the light.
    if (!(column_place >= 0 && column_place < static_cast<T>(grid.columns) && row_place >= 0 &&
          row_place < static_cast<T>(grid.rows)))
      continue;
    const std::size_t cell =
        static_cast<std::size_t>(row_place) * static_cast<std::size_t>(grid.columns) +
        static_cast<std::size_t>(column_place);
    const V point_u = hn::Set(d, u[lane]);
    const V point_v = hn::Set(d, v[lane]);
    const V point_w = hn::Set(d, w[lane]);
    const V own = hn::Set(d, id[lane]);
    const std::size_t end = grid.begins[cell + 1];
    const bool is_sorted = end - grid.begins[cell] > DistantGrid<T>::few;
    for (std::size_t i = grid.begins[cell]; i < end; i += lanes) {
      // Then this one and all behind it are farther from the light.
      if (is_sorted && grid.w[i] <= w[lane]) break;
      const V du = hn::Sub(hn::LoadU(d, &grid.u[i]), point_u);
      const V dv = hn::Sub(hn::LoadU(d, &grid.v[i]), point_v);
      const V distance2 = hn::MulAdd(du, du, hn::Mul(dv, dv));
      const M before = hn::And(hn::Gt(hn::LoadU(d, &grid.w[i]), point_w),
                               hn::Ne(hn::LoadU(d, &grid.id[i]), own));
      const M meets =
          hn::And(hn::Le(distance2, hn::LoadU(d, &grid.radius2[i])), hn::FirstN(d, end - i));
      if (!hn::AllFalse(d, hn::And(before, meets))) {
        dark[lane] = T(1);
        break;
      }
    }
  }
  return hn::Gt(hn::Load(d, dark), hn::Zero(d));
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
