// Sweeps: points in the cells of a plane across a direction, and what passes over them.

#include <hwy/cache_control.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "engine/finders/swept_points.h"

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

/// Of all cells in the rows, by the cells' bounds.
template <typename T>
HWY_NOINLINE void find_margins(SweptPoints<T>& points) {
  const std::size_t count =
      static_cast<std::size_t>(points.columns) * static_cast<std::size_t>(points.rows);
  points.margins.above.resize(count);
  points.margins.below.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    T above = points.cells[i].above;
    T below = points.cells[i].below;
    if (points.has_parts)
      for (const auto& part : points.parts_of(i)) {
        above = std::min(above, part.above);
        below = std::max(below, part.below);
      }
    points.margins.above[i] = above;
    points.margins.below[i] = below;
  }
}

/// Of blocks of cells, by the cells' margins.
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
          above = std::min(above, points.margins.above[i]);
          below = std::max(below, points.margins.below[i]);
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
  find_margins(points);
  bound_blocks(points);
}

/// Whether to ask of blocks if they may hide a point: where few can be left out, as over a flat
/// cloud, asking would cost more than it saves. Then a few are asked about, which may tell
/// otherwise.
class WorthOfAsking {
 public:
  bool asks_about(std::size_t block) const {
    return left_out_of * left_out_ >= asked_ || block % of_few == 0;
  }
  /// Takes down the answer, and returns it.
  bool leaves_out(bool answer) {
    ++asked_;
    left_out_ += answer;
    if (asked_ == remembered) {
      asked_ /= 2;
      left_out_ /= 2;
    }
    return answer;
  }

 private:
  static constexpr std::size_t left_out_of = 4;  // at least one in so many
  static constexpr std::size_t of_few = 16;
  static constexpr std::size_t remembered = 64;  // those near each other are alike
  std::size_t asked_ = 0;
  std::size_t left_out_ = 0;
};

/// Whether something in a box may hide a point, as far as the blocks of cells tell that it touches.
template <typename T>
HWY_INLINE bool may_hide(const SweptPoints<T>& points, const SweptBox<T>& box) {
  constexpr int most_across = 8;  // to look into more takes longer than what they may save
  const auto block_at = [&](T place, T low) {
    const T cell = (place - low) * points.cells_per_unit;
    constexpr T most = T(1 << 20);
    return static_cast<int>(std::floor(std::clamp(cell, T(-1), most))) >> points.block_log2;
  };
  const SweptRange<T> u(box, points.axes[0]);
  const SweptRange<T> v(box, points.axes[1]);
  const int x_begin = std::max(block_at(u.low - points.noise, points.u_low), 0);
  const int y_begin = std::max(block_at(v.low - points.noise, points.v_low), 0);
  const int x_end =
      std::min(block_at(u.high + points.noise, points.u_low) + 1, points.blocks_across());
  const int y_end =
      std::min(block_at(v.high + points.noise, points.v_low) + 1, points.blocks_down());
  if (x_end - x_begin > most_across || y_end - y_begin > most_across) return true;
  const SweptRange<T> w(box, points.axes[2]);
  for (int y = y_begin; y < y_end; ++y)
    for (int x = x_begin; x < x_end; ++x) {
      const auto& block = points.blocks[static_cast<std::size_t>(y * points.blocks_across() + x)];
      if (w.high > block.above || w.low < block.below) return true;
    }
  return false;
}

/// Sorts the points into their cells.
template <class D, typename T = hn::TFromD<D>>
HWY_NOINLINE void sort_into_cells(D d, SweptPoints<T>& points) {
  using Points = SweptPoints<T>;
  constexpr std::size_t lanes = hn::MaxLanes(D());
  constexpr std::size_t padding = 64;
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
  if (points.lanes.size() < begin + padding) {
    points.lanes.resize(begin + padding);
    points.values.resize(Points::column_count * (begin + padding));
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
        static_cast<std::uint32_t>(found.packets[i / lanes] * 16 + i % lanes);
  }
  renew_bounds(d, points);
}

/// Where primitives touch the plane, in cells.
template <class V>
struct TouchedCells {
  V x_low, y_low, x_high, y_high;
};

/// Primitives on their way over the points, each with the cells that it touches: found without a
/// branch that depends on them, and gone through later, when they are in the caches.
template <typename T>
class PassingPrimitives {
 public:
  static constexpr std::size_t most = 8192;  ///< visits

  explicit HWY_INLINE PassingPrimitives(const SweptPoints<T>& points) : points_(points) {}

  HWY_INLINE std::size_t count() const { return count_; }
  HWY_INLINE std::size_t cell(std::size_t i) const { return static_cast<std::size_t>(cells_[i]); }
  HWY_INLINE std::size_t primitive(std::size_t i) const {
    return static_cast<std::size_t>(primitives_[i]);
  }
  HWY_INLINE void clear() { count_ = 0; }

  /// Adds primitives, the one of the first lane at index `first`, at `w` along the direction, and
  /// of the cells that they touch those in which they may hide points. Returns the lanes of those
  /// that touch more than two cells either way, which are not added. There is to be room for four
  /// visits of each.
  template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
  HWY_INLINE M add(D d, std::size_t first, const TouchedCells<V>& touched, V w, M touches) {
    const hn::RebindToSigned<D> di;
    const V zero = hn::Zero(d);
    const V one = hn::Set(d, T(1));
    const V columns = hn::Set(d, static_cast<T>(points_.columns));
    const V rows = hn::Set(d, static_cast<T>(points_.rows));
    const V x = hn::Floor(hn::Max(touched.x_low, zero));
    const V y = hn::Floor(hn::Max(touched.y_low, zero));
    const V across = hn::Sub(hn::Floor(hn::Min(touched.x_high, hn::Sub(columns, one))), x);
    const V down = hn::Sub(hn::Floor(hn::Min(touched.y_high, hn::Sub(rows, one))), y);
    const M is_small = hn::And(hn::Le(across, one), hn::Le(down, one));
    const M added = hn::And(touches, is_small);
    const V cell = hn::MulAdd(y, columns, x);
    const M is_wide = hn::Gt(across, zero);
    const M is_high = hn::Gt(down, zero);
    const auto add_cells = [&](V at, M are) HWY_ATTR {
      const auto index = hn::ConvertTo(di, hn::IfThenElseZero(are, at));
      const M may_hide =
          hn::And(are, hn::Or(hn::Gt(w, hn::GatherIndex(d, points_.margins.above.data(), index)),
                              hn::Lt(w, hn::GatherIndex(d, points_.margins.below.data(), index))));
      const auto which = hn::RebindMask(di, may_hide);
      hn::CompressStore(hn::Iota(di, static_cast<Index>(first)), which, di, primitives_ + count_);
      count_ += hn::CompressStore(index, which, di, cells_ + count_);
    };
    add_cells(cell, added);
    add_cells(hn::Add(cell, one), hn::And(added, is_wide));
    add_cells(hn::Add(cell, columns), hn::And(added, is_high));
    add_cells(hn::Add(hn::Add(cell, columns), one), hn::And(added, hn::And(is_wide, is_high)));
    return hn::AndNot(is_small, touches);
  }
  /// The same for one, which may touch more. Calls go_through() when there is no room.
  template <class GoThrough>
  HWY_NOINLINE void add_large(std::size_t primitive, const TouchedCells<T>& touched, T w,
                              const GoThrough& go_through) {
    const int x_begin = std::max(static_cast<int>(touched.x_low), 0);
    const int y_begin = std::max(static_cast<int>(touched.y_low), 0);
    const int x_end = std::min(static_cast<int>(touched.x_high), points_.columns - 1);
    const int y_end = std::min(static_cast<int>(touched.y_high), points_.rows - 1);
    for (int row = y_begin; row <= y_end; ++row) {
      if (count_ + static_cast<std::size_t>(points_.columns) > most) go_through();
      for (int column = x_begin; column <= x_end; ++column) {
        const auto cell =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(points_.columns) +
            static_cast<std::size_t>(column);
        cells_[count_] = static_cast<Index>(cell);
        primitives_[count_] = static_cast<Index>(primitive);
        count_ += static_cast<std::size_t>(w > points_.margins.above[cell]) |
                  static_cast<std::size_t>(w < points_.margins.below[cell]);
      }
    }
  }

 private:
  using Index = hwy::MakeSigned<T>;
  static constexpr std::size_t vector_past_end = 16;

  const SweptPoints<T>& points_;
  std::size_t count_ = 0;
  Index cells_[most + vector_past_end];
  Index primitives_[most + vector_past_end];
};

/// Calls go(cell) with a cell, or with those that it is cut into that a primitive touches and in
/// which it may hide points.
template <typename T, class Go>
HWY_INLINE void for_each_part(const SweptPoints<T>& points, std::size_t cell,
                              const TouchedCells<T>& touched, T w, const Go& go) {
  if (!points.has_parts || points.parts[cell].across == 0) return go(points.cells[cell]);
  const auto& parts = points.parts[cell];
  const auto columns = static_cast<std::size_t>(points.columns);
  const auto across = static_cast<T>(parts.across);
  const auto most = static_cast<T>(parts.across - 1);
  const auto from_x = static_cast<T>(cell % columns);
  const auto from_y = static_cast<T>(cell / columns);
  const auto index = [&](T place, T from) {
    return static_cast<std::uint32_t>(std::clamp((place - from) * across, T(0), most));
  };
  const std::uint32_t x_end = index(touched.x_high, from_x);
  const std::uint32_t y_end = index(touched.y_high, from_y);
  for (std::uint32_t y = index(touched.y_low, from_y); y <= y_end; ++y)
    for (std::uint32_t x = index(touched.x_low, from_x); x <= x_end; ++x) {
      const auto& part = points.cells[parts.first + y * parts.across + x];
      if (w > part.above || w < part.below) go(part);
    }
}

/// Puts out the light of a cell's points of which `hides(get)` says that it is hidden.
template <class D, class Hides, typename T = hn::TFromD<D>>
HWY_INLINE void hide_in_cell(D d, SweptPoints<T>& points, const typename SweptPoints<T>::Cell& cell,
                             const Hides& hides) {
  using Points = SweptPoints<T>;
  const std::size_t size = cell.end - cell.begin;
  T* const values = points.values.data() + Points::column_count * cell.begin;
  for (std::size_t i = 0; i < size; i += hn::Lanes(d)) {
    const auto get = [&](std::size_t column)
                         HWY_ATTR { return hn::LoadU(d, values + column * size + i); };
    const auto hidden = hn::And(hides(get), hn::FirstN(d, size - i));
    // Behind the cell's end, what is there.
    hn::StoreU(hn::IfThenZeroElse(hidden, get(Points::column_side)), d,
               values + Points::column_side * size + i);
  }
}

/// Sets the bits of the points that lie in the dark.
template <typename T>
HWY_NOINLINE void tell_dark(const SweptPoints<T>& points, std::uint16_t* dark) {
  using Points = SweptPoints<T>;
  for (const auto& cell : points.cells) {
    const std::size_t size = cell.end - cell.begin;
    const T* const side =
        points.values.data() + Points::column_count * cell.begin + Points::column_side * size;
    for (std::size_t i = 0; i < size; ++i) {
      const std::uint32_t lane = points.lanes[cell.begin + i];
      const unsigned bit = side[i] == 0 ? 1 : 0;
      dark[lane / 16] = static_cast<std::uint16_t>(dark[lane / 16] | bit << lane % 16);
    }
  }
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
