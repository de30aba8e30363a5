// The pixels of a part that are integrated, and the lines across them.

#if defined(RAYTRACER_KERNEL_SIMD_PART_PIXELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_PART_PIXELS_INL_H_
#undef RAYTRACER_KERNEL_SIMD_PART_PIXELS_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_PART_PIXELS_INL_H_
#endif

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/kernel/simd/lines-inl.h"
#include "engine/kernel/simd/pixel_edges-inl.h"
#include "engine/math/block.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// In an order of its own: first the rough pixels, which get several lines, then the even ones,
/// which get one.
template <class D>
class PartPixels {
 public:
  using T = hn::TFromD<D>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  static constexpr std::size_t most = std::size_t{part_side} * part_side;
  static constexpr std::size_t places = most + 16;  ///< with as many more as a packet has lanes

  /// Those at these places in the block, column + block_side * row. `edges_of` tells the PixelEdges
  /// of those with such (columns, rows).
  template <class EdgesOf>
  HWY_INLINE void set(D d, std::span<const std::uint8_t> pixels, const EdgesOf& edges_of) {
    count_ = pixels.size();
    for (std::size_t i = 0; i < count_; ++i) {
      const int x = pixels[i] % block_side;
      const int y = pixels[i] / block_side;
      found_[Column::x][i] = static_cast<T>(x);
      found_[Column::y][i] = static_cast<T>(y);
    }
    const V one = hn::Set(d, T(1));
    for (std::size_t i = 0; i < count_; i += lanes) {
      const PixelEdges<D> edges =
          edges_of(hn::Load(d, found_[Column::x] + i), hn::Load(d, found_[Column::y] + i));
      // Lines go across the edges: along a line one moves from one side to the other at once, and
      // only many lines see how far.
      hn::Store(hn::IfThenElseZero(edges.are_level(), one), d, found_[Column::is_upright] + i);
      hn::Store(hn::IfThenElseZero(edges.are_there(), one), d, found_[Column::has_edge] + i);
      hn::Store(edges.bend(), d, found_[Column::bends] + i);
      hn::Store(hn::Iota(d, static_cast<T>(i)), d, found_[Column::number] + i);
      hn::Store(hn::IfThenElseZero(edges.are_even(), one), d, is_even_ + i);
    }
    sort(d, true);
  }

  /// From here on no pixel counts as even.
  HWY_INLINE void make_rough(D d) { sort(d, false); }

  /// At (k + 1/2) / count of the rough pixels' sides, one of each pixel after another, then in the
  /// middle of the even ones.
  HWY_INLINE void draw(D d, std::size_t line_count, Lines<T>& lines) const {
    lines.count = 0;
    for (std::size_t k = 0; k < line_count && rough_count_ > 0; ++k) {
      const double place = (static_cast<double>(k) + 0.5) / static_cast<double>(line_count);
      draw(d, static_cast<T>(place - 0.5), 0, rough_count_, lines);
    }
    lines.rough_end = lines.count;
    lines.rough_pixels = rough_count_;
    if (rough_count_ < count_) draw(d, 0, rough_count_, count_, lines);
  }

  std::size_t count() const { return count_; }
  std::size_t rough_count() const { return rough_count_; }
  /// As which of the places that set() was told the i-th was.
  std::size_t number_of(std::size_t i) const {
    return static_cast<std::size_t>(sorted_.values[Column::number][i]);
  }
  /// Of the packet that begins with the i-th, as PixelEdges says.
  HWY_INLINE M have_edge(D d, std::size_t i) const {
    return hn::Gt(get(d, Column::has_edge, i), hn::Zero(d));
  }
  HWY_INLINE V bend(D d, std::size_t i) const { return get(d, Column::bends, i); }

 private:
  static constexpr std::size_t lanes = hn::MaxLanes(D());
  struct Column {
    enum Name : std::size_t { x, y, is_upright, has_edge, bends, number, end };
  };

  HWY_INLINE V get(D d, typename Column::Name column, std::size_t i) const {
    return hn::LoadU(d, sorted_.values[column] + i);
  }

  HWY_INLINE void sort(D d, bool may_be_even) {
    const V zero = hn::Zero(d);
    sorted_.count = 0;
    const auto push = [&](bool is_even) HWY_ATTR {
      for (std::size_t i = 0; i < count_; i += lanes) {
        const M even = may_be_even ? hn::Gt(hn::Load(d, is_even_ + i), zero) : hn::Lt(zero, zero);
        const M which = is_even ? even : hn::Not(even);
        const auto found = [&](typename Column::Name column)
                               HWY_ATTR { return hn::Load(d, found_[column] + i); };
        sorted_.push(d, hn::And(which, hn::FirstN(d, count_ - i)), found(Column::x),
                     found(Column::y), found(Column::is_upright), found(Column::has_edge),
                     found(Column::bends), found(Column::number));
      }
    };
    push(false);
    rough_count_ = sorted_.count;
    push(true);
  }

  /// One in each of these, so far from its middle.
  HWY_INLINE void draw(D d, T place, std::size_t begin, std::size_t end, Lines<T>& lines) const {
    const V from_middle = hn::Set(d, place);
    const V half = hn::Set(d, T(0.5));
    for (std::size_t i = begin; i < end; i += lanes) {
      const V x = get(d, Column::x, i);
      const V y = get(d, Column::y, i);
      const V is_upright = get(d, Column::is_upright, i);
      const M upright = hn::Gt(is_upright, hn::Zero(d));
      const V right = hn::IfThenElse(upright, hn::Add(hn::Add(x, half), from_middle), x);
      const V down = hn::IfThenElse(upright, y, hn::Sub(hn::Sub(y, half), from_middle));
      const std::size_t to = lines.count + i - begin;
      hn::StoreU(right, d, lines.right + to);
      hn::StoreU(down, d, lines.down + to);
      hn::StoreU(is_upright, d, lines.is_upright + to);
    }
    lines.count += end - begin;
  }

  alignas(64) T found_[Column::end][places] = {};  ///< in the order of set()
  alignas(64) T is_even_[places];
  Queue<D, Column::end, most> sorted_;
  std::size_t count_ = 0;
  std::size_t rough_count_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
