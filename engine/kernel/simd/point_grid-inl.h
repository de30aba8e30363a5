// A packet's shadow rays to a point light, by the cube of grids around the light.

#if defined(RAYTRACER_KERNEL_SIMD_POINT_GRID_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_POINT_GRID_INL_H_
#undef RAYTRACER_KERNEL_SIMD_POINT_GRID_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_POINT_GRID_INL_H_
#endif

#include "engine/accel/point_grid.h"
#include "engine/kernel/simd/cells-inl.h"
#include "engine/kernel/simd/hit-inl.h"
#include "engine/kernel/simd/sphere-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// The cells in which the directions `out` from the light leave its cube.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE V cube_cells(D d, const PointGrid<T>& grid, const V3<V>& out) {
  const V3<V> size{hn::Abs(out.x), hn::Abs(out.y), hn::Abs(out.z)};
  const M is_x = hn::And(hn::Ge(size.x, size.y), hn::Ge(size.x, size.z));
  const M is_y = hn::Ge(size.y, size.z);
  const auto pick = [&](V x, V y, V z)
                        HWY_ATTR { return hn::IfThenElse(is_x, x, hn::IfThenElse(is_y, y, z)); };
  const V along = pick(out.x, out.y, out.z);
  const V scale = hn::Div(hn::Set(d, T(0.5)), hn::Abs(along));
  const V side = hn::Set(d, static_cast<T>(grid.side));
  const V last = hn::Set(d, static_cast<T>(grid.side - 1));
  const auto place = [&](V across) HWY_ATTR {
    const V share = hn::MulAdd(across, scale, hn::Set(d, T(0.5)));
    return hn::Min(hn::Max(hn::Floor(hn::Mul(share, side)), hn::Zero(d)), last);
  };
  const V column = place(pick(out.y, out.z, out.x));
  const V row = place(pick(out.z, out.x, out.y));
  const V axis = pick(hn::Zero(d), hn::Set(d, T(2)), hn::Set(d, T(4)));
  const V face = hn::IfThenElse(hn::Lt(along, hn::Zero(d)), hn::Add(axis, hn::Set(d, T(1))), axis);
  return hn::MulAdd(hn::MulAdd(face, side, row), side, column);
}

/// Lanes of `lit` from which a sphere of the grid stands before the light at `place`.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_in_point_grid(D d, const PointGrid<T>& grid, const Triple<T>& place,
                                    const Start<V>& from, const V3<V>& towards, M lit) {
  const V3<V> out = sub(from.point, broadcast(d, place));
  const V path = hn::Sqrt(dot(out, out));
  const V cell = cube_cells(d, grid, out);
  constexpr std::size_t most_lanes = hn::MaxLanes(D());
  HWY_ALIGN T paths[most_lanes];
  HWY_ALIGN T ids[most_lanes];
  HWY_ALIGN T towards_x[most_lanes];
  HWY_ALIGN T towards_y[most_lanes];
  HWY_ALIGN T towards_z[most_lanes];
  hn::Store(path, d, paths);
  hn::Store(from.id, d, ids);
  HWY_ALIGN T points_x[most_lanes];
  HWY_ALIGN T points_y[most_lanes];
  HWY_ALIGN T points_z[most_lanes];
  hn::Store(from.point.x, d, points_x);
  hn::Store(from.point.y, d, points_y);
  hn::Store(from.point.z, d, points_z);
  hn::Store(towards.x, d, towards_x);
  hn::Store(towards.y, d, towards_y);
  hn::Store(towards.z, d, towards_z);

  using Grid = PointGrid<T>;
  M dark = hn::Lt(path, hn::Zero(d));
  std::uint64_t dark_alone = 0;
  const auto test_together = [&](std::size_t begin, std::size_t end, M lanes) HWY_ATTR {
    const T* const values = grid.spheres.cell(begin);
    const std::size_t count = end - begin;
    for (std::size_t i = 0; i < count; ++i) {
      const auto all = [&](typename Grid::Column column)
                           HWY_ATTR { return hn::Set(d, values[column * count + i]); };
      const V3<V> center{all(Grid::x), all(Grid::y), all(Grid::z)};
      const V radius2 = all(Grid::radius2);
      const M meets =
          grid.is_far ? stands_before_far_light(d, center, radius2, from.point, towards, path)
                      : stands_before_light(d, center, radius2, all(Grid::nearest), towards, path);
      const M other = hn::Ne(all(Grid::id), from.id);
      dark = hn::Or(dark, hn::And(lanes, hn::And(meets, other)));
    }
  };
  const auto test_alone = [&](std::size_t begin, std::size_t end, std::size_t lane) HWY_ATTR {
    const T* const values = grid.spheres.cell(begin);
    const std::size_t count = end - begin;
    const V3<V> own_towards =
        broadcast(d, Triple<T>{towards_x[lane], towards_y[lane], towards_z[lane]});
    const V3<V> own_point = broadcast(d, Triple<T>{points_x[lane], points_y[lane], points_z[lane]});
    const V own_path = hn::Set(d, paths[lane]);
    const V own_id = hn::Set(d, ids[lane]);
    for (std::size_t i = 0; i < count; i += most_lanes) {
      const auto next = [&](typename Grid::Column column)
                            HWY_ATTR { return hn::LoadU(d, values + column * count + i); };
      // Then this one and all behind it are beyond the point.
      if (values[Grid::nearest * count + i] > paths[lane]) break;
      const V3<V> centers{next(Grid::x), next(Grid::y), next(Grid::z)};
      const V radius2 = next(Grid::radius2);
      const M meets = grid.is_far ? stands_before_far_light(d, centers, radius2, own_point,
                                                            own_towards, own_path)
                                  : stands_before_light(d, centers, radius2, next(Grid::nearest),
                                                        own_towards, own_path);
      const M other = hn::And(hn::FirstN(d, count - i), hn::Ne(next(Grid::id), own_id));
      if (!hn::AllFalse(d, hn::And(meets, other))) {
        dark_alone |= std::uint64_t{1} << lane;
        break;
      }
    }
  };
  for_each_cell(d, grid.begins, cell, lit, test_together, test_alone);
  return hn::And(lit, hn::Or(dark, mask_of(d, dark_alone)));
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
