// Which cells of a grid a packet's lanes are in, and the lanes that share one.

#if defined(RAYTRACER_KERNEL_SIMD_CELLS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_CELLS_INL_H_
#undef RAYTRACER_KERNEL_SIMD_CELLS_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_CELLS_INL_H_
#endif

#include <hwy/cache_control.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "engine/kernel/simd/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// Points as a distant light's grid has them: `u` and `v` across the light, `w` towards it.
template <class V, class M>
struct GridPlaces {
  V u;
  V v;
  V w;
  V column;
  V row;
  M is_on_grid;
};

template <class D, class Grid, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE GridPlaces<V, M> places_on(D d, const Grid& grid, const V3<V>& point) {
  using T = hn::TFromD<D>;
  const V zero = hn::Zero(d);
  const auto along = [&](const Vec3& axis) HWY_ATTR {
    return dot(point, broadcast(d, Triple<T>{static_cast<T>(axis.x), static_cast<T>(axis.y),
                                             static_cast<T>(axis.z)}));
  };
  const auto cell = [&](V coordinate, T low) HWY_ATTR {
    return hn::Floor(
        hn::Mul(hn::Sub(coordinate, hn::Set(d, low)), hn::Set(d, grid.cells_per_unit)));
  };
  const V u = along(grid.axes[0]);
  const V v = along(grid.axes[1]);
  const V column = cell(u, grid.u_low);
  const V row = cell(v, grid.v_low);
  const M in_columns =
      hn::And(hn::Ge(column, zero), hn::Lt(column, hn::Set(d, static_cast<T>(grid.columns))));
  const M in_rows = hn::And(hn::Ge(row, zero), hn::Lt(row, hn::Set(d, static_cast<T>(grid.rows))));
  return {u, v, along(grid.axes[2]), column, row, hn::And(in_columns, in_rows)};
}

/// Whether testing `entry_count` spheres against a whole packet costs less than testing one point
/// after another of `lane_count` against a packet of spheres.
HWY_INLINE bool suits_packet(std::size_t entry_count, std::size_t lane_count, std::size_t lanes) {
  return entry_count <= lane_count * ((entry_count + lanes - 1) / lanes);
}

/// Visits the entries of each lane's cell, for the lanes of `rest`; cell i's entries begin at
/// `begins[i]`. Calls `test_together(begin, end, lanes)`, to test each entry against all `lanes`,
/// which may be more than those of `rest`, or `test_alone(begin, end, lane)`, to test the one lane
/// against a packet of entries after another, whichever costs less.
template <class D, class Begins, class Together, class Alone, class V = hn::Vec<D>,
          class M = hn::Mask<D>>
HWY_INLINE void for_each_cell(D d, const Begins& begins, V cell, M rest,
                              const Together& test_together, const Alone& test_alone) {
  using T = hn::TFromD<D>;
  constexpr std::size_t most_lanes = hn::MaxLanes(D());
  HWY_ALIGN T cells[most_lanes];
  hn::Store(cell, d, cells);
  std::uint64_t lanes_left = bits_of(d, rest);
  while (lanes_left != 0) {
    const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero64(lanes_left);
    const auto index = static_cast<std::uint32_t>(cells[lane]);
    const std::size_t begin = begins[index];
    const std::size_t end = begins[index + 1];
    const M equal = hn::Eq(cell, hn::Set(d, cells[lane]));
    const std::uint64_t together = bits_of(d, equal) & lanes_left;
    if (suits_packet(end - begin, hwy::PopCount(together), most_lanes)) {
      test_together(begin, end, equal);
      lanes_left &= ~together;
    } else {
      test_alone(begin, end, lane);
      lanes_left &= lanes_left - 1;
    }
  }
}

/// Asks the memory for each lane's cell, for the lanes of `rest`: whole if it has few entries, else
/// for its first lines.
template <class D, class Grid, class Columns, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE void fetch_cells(D d, const Grid& grid, const Columns& columns, V cell, M rest) {
  using T = hn::TFromD<D>;
  constexpr std::size_t line = 64 / sizeof(T);
  constexpr std::size_t most = 6 * line;
  HWY_ALIGN T cells[hn::MaxLanes(D())];
  hn::Store(cell, d, cells);
  auto fetched = std::numeric_limits<std::uint32_t>::max();
  for (std::uint64_t left = bits_of(d, rest); left != 0; left &= left - 1) {
    const auto index = static_cast<std::uint32_t>(cells[hwy::Num0BitsBelowLS1Bit_Nonzero64(left)]);
    if (index == fetched) continue;  // as neighbours often are
    fetched = index;
    const T* const begin = columns.cell(grid.begins[index]);
    const auto count = static_cast<std::size_t>(columns.cell(grid.begins[index + 1]) - begin);
    for (std::size_t at = 0; at < std::min(count, most); at += line) hwy::Prefetch(begin + at);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
