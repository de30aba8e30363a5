// Sweeps: points in the cells of a plane across a direction.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "engine/finders/swept_points.h"
#include "engine/packets/lane_bits.h"
#include "engine/packets/padding.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Chooses the plane's cells, for so many points that are between these places.
template <typename T>
void choose_cells(T u_low, T v_low, T u_high, T v_high, std::size_t count, SweptPoints<T>& points) {
  // A cell's points fill a packet in most cases, and more than one seldom.
  constexpr double per_cell = 5;
  constexpr double most_across = 2048;
  constexpr double not_zero = 1e-30;
  const double width = static_cast<double>(u_high) - static_cast<double>(u_low);
  const double height = static_cast<double>(v_high) - static_cast<double>(v_low);
  const double cell = std::max({std::sqrt(width * height * per_cell / static_cast<double>(count)),
                                width / most_across, height / most_across, not_zero});
  points.u_low = u_low;
  points.v_low = v_low;
  points.cells_per_unit = static_cast<T>(1 / cell);
  points.columns = static_cast<int>((u_high - u_low) * points.cells_per_unit) + 1;
  points.rows = static_cast<int>((v_high - v_low) * points.cells_per_unit) + 1;
  points.noise = 16 * std::numeric_limits<T>::epsilon() *
                 std::max({std::abs(u_low), std::abs(v_low), std::abs(u_high), std::abs(v_high)});
}

/// The cell of each point that was found, and, in their ends, how many points cells have. Those
/// that look to neither end are in one behind all others.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE void find_cells(D d, SweptPoints<T>& points) {
  using Points = SweptPoints<T>;
  const std::size_t cell_count =
      static_cast<std::size_t>(points.columns) * static_cast<std::size_t>(points.rows);
  points.cells.assign(cell_count + 1, {});
  auto& found = points.found;
  const V zero = hn::Zero(d);
  const V columns = hn::Set(d, static_cast<T>(points.columns));
  const V rows = hn::Set(d, static_cast<T>(points.rows));
  const V none = hn::Set(d, static_cast<T>(cell_count));
  HWY_ALIGN T cells[hn::MaxLanes(D())];
  for (std::size_t i = 0; i < found.count; i += hn::MaxLanes(D())) {
    const auto along = [&](std::size_t column, T low) HWY_ATTR {
      return hn::Mul(hn::Sub(hn::LoadU(d, found.values[column].data() + i), hn::Set(d, low)),
                     hn::Set(d, points.cells_per_unit));
    };
    const V x = along(Points::column_u, points.u_low);
    const V y = along(Points::column_v, points.v_low);
    const V side = hn::LoadU(d, found.values[Points::column_side].data() + i);
    const auto is_in =
        hn::And(hn::And(hn::Ne(side, zero), hn::And(hn::Ge(x, zero), hn::Ge(y, zero))),
                hn::And(hn::Lt(x, columns), hn::Lt(y, rows)));
    const V cell = hn::MulAdd(hn::Floor(y), columns, hn::Floor(x));
    hn::Store(hn::IfThenElse(is_in, cell, none), d, cells);
    for (std::size_t lane = 0; lane < hn::MaxLanes(D()); ++lane) {
      const auto index = static_cast<std::uint32_t>(cells[lane]);
      found.cells[i + lane] = index;
      ++points.cells[index].end;
    }
  }
}

/// Cuts crowded cells into such as others are, and finds those of their points.
template <typename T>
HWY_NOINLINE void cut_crowded_cells(SweptPoints<T>& points) {
  using Points = SweptPoints<T>;
  constexpr std::uint32_t crowd = 64;
  constexpr std::uint32_t per_cell = 8;
  constexpr std::uint32_t most_across = 512;
  const std::size_t cell_count = points.cells.size() - 1;
  points.has_parts = false;
  for (std::size_t i = 0; i < cell_count; ++i)
    points.has_parts = points.has_parts || points.cells[i].end > crowd;
  if (!points.has_parts) return;
  const typename Points::Cell outside = points.cells.back();
  points.cells.pop_back();
  points.parts.assign(cell_count, {0, 0});
  for (std::size_t i = 0; i < cell_count; ++i) {
    const std::uint32_t count = points.cells[i].end;
    if (count <= crowd) continue;
    std::uint32_t across = 2;
    while (across < most_across && count > per_cell * across * across) across *= 2;
    points.parts[i] = {static_cast<std::uint32_t>(points.cells.size()), across};
    points.cells[i].end = 0;
    points.cells.resize(points.cells.size() + across * across);
  }
  const auto last = static_cast<std::uint32_t>(points.cells.size());
  points.cells.push_back(outside);
  auto& found = points.found;
  const auto columns = static_cast<std::uint32_t>(points.columns);
  for (std::size_t i = 0; i < found.count; ++i) {
    const std::uint32_t index = found.cells[i];
    if (index >= cell_count) {
      found.cells[i] = last;
      continue;
    }
    const auto& parts = points.parts[index];
    if (parts.across == 0) continue;
    const T x = (found.values[Points::column_u][i] - points.u_low) * points.cells_per_unit;
    const T y = (found.values[Points::column_v][i] - points.v_low) * points.cells_per_unit;
    const std::uint32_t row = index / columns;
    const auto across = static_cast<T>(parts.across);
    const auto part_x =
        static_cast<std::uint32_t>((x - static_cast<T>(index - row * columns)) * across);
    const auto part_y = static_cast<std::uint32_t>((y - static_cast<T>(row)) * across);
    const std::uint32_t part = parts.first + part_y * parts.across + part_x;
    found.cells[i] = part;
    ++points.cells[part].end;
  }
}

/// Of blocks of cells, by the cells'.
template <typename T>
HWY_NOINLINE void bound_blocks(SweptPoints<T>& points) {
  constexpr int across = 1 << SweptPoints<T>::block_log2;
  points.blocks.clear();
  for (int y = 0; y < points.rows; y += across)
    for (int x = 0; x < points.columns; x += across) {
      T above = std::numeric_limits<T>::max();
      T below = std::numeric_limits<T>::lowest();
      for (int row = y; row < std::min(y + across, points.rows); ++row)
        for (int column = x; column < std::min(x + across, points.columns); ++column) {
          const auto i = static_cast<std::size_t>(row) * static_cast<std::size_t>(points.columns) +
                         static_cast<std::size_t>(column);
          above = std::min(above, points.cells[i].above);
          below = std::max(below, points.cells[i].below);
        }
      points.blocks.push_back({above, below});
    }
}

/// Of a cell, by its points that are not known to lie in the dark.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE void renew_bounds(D d, SweptPoints<T>& points) {
  using Points = SweptPoints<T>;
  points.visits = 0;
  const V zero = hn::Zero(d);
  const V highest = hn::Set(d, std::numeric_limits<T>::max());
  for (auto& cell : points.cells) {
    const std::size_t size = cell.end - cell.begin;
    const T* const values = points.values.data() + Points::column_count * cell.begin;
    V above = highest;
    V below = hn::Neg(highest);
    for (std::size_t i = 0; i < size; i += hn::Lanes(d)) {
      const V w = hn::LoadU(d, values + Points::column_w * size + i);
      const V side = hn::IfThenElseZero(hn::FirstN(d, size - i),
                                        hn::LoadU(d, values + Points::column_side * size + i));
      above = hn::Min(above, hn::IfThenElse(hn::Gt(side, zero), w, highest));
      below = hn::Max(below, hn::IfThenElse(hn::Lt(side, zero), w, hn::Neg(highest)));
    }
    cell.above = hn::GetLane(hn::MinOfLanes(d, above));
    cell.below = hn::GetLane(hn::MaxOfLanes(d, below));
  }
  for (std::size_t i = 0; points.has_parts && i < points.parts.size(); ++i)
    for (const auto& part : points.parts_of(i)) {
      points.cells[i].above = std::min(points.cells[i].above, part.above);
      points.cells[i].below = std::max(points.cells[i].below, part.below);
    }
  bound_blocks(points);
}

/// Sorts the points into their cells.
template <class D, typename T = hn::TFromD<D>>
HWY_NOINLINE void sort_into_cells(D d, SweptPoints<T>& points) {
  using Points = SweptPoints<T>;
  constexpr std::size_t lanes = hn::MaxLanes(D());
  static_assert(lanes <= most_lanes);
  auto& found = points.found;
  std::uint32_t begin = 0;
  const auto outside = static_cast<std::uint32_t>(points.cells.size() - 1);
  points.cells.back().end = 0;
  for (auto& cell : points.cells) {
    const std::uint32_t size = cell.end;
    cell.begin = begin;
    cell.end = begin;
    begin += size;
  }
  if (points.lanes.size() < begin + packet_padding) {
    points.lanes.resize(begin + packet_padding);
    points.values.resize(Points::column_count * (begin + packet_padding));
  }
  for (std::size_t i = 0; i < found.count; ++i) {
    const std::uint32_t index = found.cells[i];
    if (index == outside) continue;
    auto& cell = points.cells[index];
    const std::size_t size = points.cells[index + 1].begin - cell.begin;
    T* const to =
        points.values.data() + Points::column_count * cell.begin + (cell.end - cell.begin);
    for (std::size_t column = 0; column < Points::column_count; ++column)
      to[column * size] = found.values[column][i];
    points.lanes[cell.end++] =
        static_cast<std::uint32_t>(found.packets[i / lanes] * most_lanes + i % lanes);
  }
  renew_bounds(d, points);
}

/// Sets the bits of the points that lie in the dark.
template <typename T>
HWY_NOINLINE void tell_dark(const SweptPoints<T>& points, LaneBits* dark) {
  using Points = SweptPoints<T>;
  for (const auto& cell : points.cells) {
    const std::size_t size = cell.end - cell.begin;
    const T* const side =
        points.values.data() + Points::column_count * cell.begin + Points::column_side * size;
    for (std::size_t i = 0; i < size; ++i) {
      const std::uint32_t lane = points.lanes[cell.begin + i];
      const unsigned bit = side[i] == 0 ? 1 : 0;
      LaneBits& packet = dark[lane / most_lanes];
      packet = static_cast<LaneBits>(packet | bit << lane % most_lanes);
    }
  }
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
