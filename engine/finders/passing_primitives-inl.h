// Sweeps: what passes over the points in the cells of a plane.

#include <hwy/cache_control.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "engine/finders/swept_points.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

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
  for (int y = y_begin; y < y_end; ++y) {
    const auto first =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(points.blocks_across());
    for (int x = x_begin; x < x_end; ++x) {
      const auto& block = points.blocks[first + static_cast<std::size_t>(x)];
      if (w.high > block.above || w.low < block.below) return true;
    }
  }
  return false;
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
  static constexpr std::size_t most = 8192;     ///< visits
  static constexpr std::size_t most_cells = 8;  ///< either way, of what is added in vectors
  /// Whether to add primitives in vectors. Measured: with 8 lanes sweeps take 1.1 to 1.4 times as
  /// long, with 16 0.5 to 0.8.
  template <class D>
  static constexpr bool in_vectors = hn::MaxLanes(D()) >= 16;

  explicit HWY_INLINE PassingPrimitives(const SweptPoints<T>& points) : points_(points) {}

  HWY_INLINE std::size_t count() const { return count_; }
  HWY_INLINE std::size_t cell(std::size_t i) const { return static_cast<std::size_t>(cells_[i]); }
  HWY_INLINE std::size_t primitive(std::size_t i) const {
    return static_cast<std::size_t>(primitives_[i]);
  }
  HWY_INLINE void clear() { count_ = 0; }

  /// Adds primitives, the one of the first lane at index `first`, at `w` along the direction, and
  /// of the cells that they touch those in which they may hide points. Returns the lanes of those
  /// that touch more than most_cells either way, which are not added. There is to be room for all
  /// visits.
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
    const V most_steps = hn::Set(d, static_cast<T>(most_cells - 1));
    const M is_small = hn::And(hn::Le(across, most_steps), hn::Le(down, most_steps));
    const M added = hn::And(touches, is_small);
    V row = hn::MulAdd(y, columns, x);
    V step_down = zero;
    for (M in_row = added; !hn::AllFalse(d, in_row);
         in_row = hn::And(added, hn::Le(step_down, down))) {
      V cell = row;
      V step = zero;
      for (M are = in_row; !hn::AllFalse(d, are); are = hn::And(in_row, hn::Le(step, across))) {
        add_cells(d, hn::Iota(di, static_cast<Index>(first)), cell, w, are);
        cell = hn::Add(cell, one);
        step = hn::Add(step, one);
      }
      row = hn::Add(row, columns);
      step_down = hn::Add(step_down, one);
    }
    return hn::AndNot(is_small, touches);
  }

  /// The same for one, which may touch any. Calls go_through() when there is no room.
  template <class GoThrough>
  HWY_INLINE void add(std::size_t primitive, const TouchedCells<T>& touched, T w,
                      const GoThrough& go_through) {
    const int x_begin = std::max(static_cast<int>(touched.x_low), 0);
    const int y_begin = std::max(static_cast<int>(touched.y_low), 0);
    const int x_end = std::min(static_cast<int>(touched.x_high), points_.columns - 1);
    const int y_end = std::min(static_cast<int>(touched.y_high), points_.rows - 1);
    for (int row = y_begin; row <= y_end; ++row) {
      if (count_ + static_cast<std::size_t>(points_.columns) > most) go_through();
      const auto first = static_cast<std::size_t>(row) * static_cast<std::size_t>(points_.columns);
      for (int column = x_begin; column <= x_end; ++column) {
        const std::size_t index = first + static_cast<std::size_t>(column);
        const auto& cell = points_.cells[index];
        cells_[count_] = static_cast<Index>(index);
        primitives_[count_] = static_cast<Index>(primitive);
        hwy::Prefetch(points_.values.data() + SweptPoints<T>::column_count * cell.begin);
        count_ +=
            static_cast<std::size_t>(w > cell.above) | static_cast<std::size_t>(w < cell.below);
      }
    }
  }

 private:
  using Index = hwy::MakeSigned<T>;
  static constexpr std::size_t vector_past_end = 16;

  /// Of these cells, one in each lane, those in which it may hide points.
  template <class D, class V, class M, class Primitives>
  HWY_INLINE void add_cells(D d, Primitives primitives, V cells, V w, M are) {
    using Cell = typename SweptPoints<T>::Cell;
    constexpr std::size_t stride = sizeof(Cell) / sizeof(T);
    static_assert(sizeof(Cell) % sizeof(T) == 0 && offsetof(Cell, above) == 0);
    const hn::RebindToSigned<D> di;
    const auto index = hn::ConvertTo(di, hn::IfThenElseZero(are, cells));
    const auto place = hn::Mul(index, hn::Set(di, static_cast<Index>(stride)));
    const V above = hn::GatherIndex(d, &points_.cells[0].above, place);
    const V below = hn::GatherIndex(d, &points_.cells[0].below, place);
    const M may_hide = hn::And(are, hn::Or(hn::Gt(w, above), hn::Lt(w, below)));
    const auto which = hn::RebindMask(di, may_hide);
    hn::StoreU(hn::Compress(primitives, which), di, primitives_ + count_);
    hn::StoreU(hn::Compress(index, which), di, cells_ + count_);
    count_ += count_true(d, may_hide);
  }

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
  const std::size_t row = cell / columns;
  const auto from_y = static_cast<T>(row);
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

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
