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

/// Whether testing `entry_count` spheres against a whole packet costs less than testing one point
/// after another of `lane_count` against a packet of spheres.
HWY_INLINE bool suits_packet(std::size_t entry_count, std::size_t lane_count, std::size_t lanes) {
  return entry_count <= lane_count * ((entry_count + lanes - 1) / lanes);
}

/// Lanes of `lit` from which a sphere of the grid stands before its distant light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_in_grid(D d, const DistantGrid<T>& grid, const Start<V>& from, M lit) {
  const V zero = hn::Zero(d);
  const auto along = [&](const Vec3& axis) HWY_ATTR {
    return dot(from.point, broadcast(d, Triple<T>{static_cast<T>(axis.x), static_cast<T>(axis.y),
                                                  static_cast<T>(axis.z)}));
  };
  const V u = along(grid.axes[0]);
  const V v = along(grid.axes[1]);
  const V w = along(grid.axes[2]);
  const auto place = [&](V coordinate, T low) HWY_ATTR {
    return hn::Floor(
        hn::Mul(hn::Sub(coordinate, hn::Set(d, low)), hn::Set(d, grid.cells_per_unit)));
  };
  const V column = place(u, grid.u_low);
  const V row = place(v, grid.v_low);
  const V columns = hn::Set(d, static_cast<T>(grid.columns));
  const V rows = hn::Set(d, static_cast<T>(grid.rows));
  const V cell = hn::MulAdd(row, columns, column);
  // Off the grid nothing stands before the light.
  M rest = hn::And(lit, hn::And(hn::And(hn::Ge(column, zero), hn::Lt(column, columns)),
                                hn::And(hn::Ge(row, zero), hn::Lt(row, rows))));

  constexpr std::size_t most_lanes = hn::MaxLanes(D());
  HWY_ALIGN T cells[most_lanes];
  HWY_ALIGN T us[most_lanes];
  HWY_ALIGN T vs[most_lanes];
  HWY_ALIGN T ws[most_lanes];
  HWY_ALIGN T ids[most_lanes];
  hn::Store(cell, d, cells);
  hn::Store(u, d, us);
  hn::Store(v, d, vs);
  hn::Store(w, d, ws);
  hn::Store(from.id, d, ids);
  M dark = hn::Lt(zero, zero);
  while (!hn::AllFalse(d, rest)) {
    const auto lane = static_cast<std::size_t>(hn::FindFirstTrue(d, rest));
    const auto index = static_cast<std::size_t>(cells[lane]);
    const std::size_t begin = grid.begins[index];
    const std::size_t end = grid.begins[index + 1];
    const M together = hn::And(rest, hn::Eq(cell, hn::Set(d, cells[lane])));
    if (suits_packet(end - begin, hn::CountTrue(d, together), most_lanes)) {
      rest = hn::AndNot(together, rest);
      for (std::size_t i = begin; i < end; ++i) {
        const V du = hn::Sub(hn::Set(d, grid.u[i]), u);
        const V dv = hn::Sub(hn::Set(d, grid.v[i]), v);
        const M meets = hn::Le(hn::MulAdd(du, du, hn::Mul(dv, dv)), hn::Set(d, grid.radius2[i]));
        const M before =
            hn::And(hn::Gt(hn::Set(d, grid.w[i]), w), hn::Ne(hn::Set(d, grid.id[i]), from.id));
        dark = hn::Or(dark, hn::And(together, hn::And(meets, before)));
      }
      continue;
    }
    const M alone = hn::Eq(hn::Iota(d, T(0)), hn::Set(d, static_cast<T>(lane)));
    rest = hn::AndNot(alone, rest);
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
  }
  return dark;
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
