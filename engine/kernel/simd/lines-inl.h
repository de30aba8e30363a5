// Lines across pixels, and what is found along them, side by side.

#if defined(RAYTRACER_KERNEL_SIMD_LINES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_LINES_INL_H_
#undef RAYTRACER_KERNEL_SIMD_LINES_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_LINES_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "engine/kernel/line_pattern.h"
#include "engine/kernel/simd/eye-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// Lines as long as a pixel's side, by where they begin, and the integrals of the colours along
/// them. There are as many more places as a packet has lanes.
template <typename T>
struct Lines {
  static constexpr std::size_t most = most_lines_of_pixel;
  static constexpr std::size_t places = most + 16;
  std::size_t count = 0;             ///< one of each pixel after another
  std::size_t pixel_count = 1;       ///< at most 16
  alignas(64) T right[places];       ///< in pixels, of the block's left side
  alignas(64) T down[places];        ///< in pixels, of the block's first row's lower side
  alignas(64) T is_upright[places];  ///< 1 for those that go upwards, 0 for those to the right
  alignas(64) T red[places];
  alignas(64) T green[places];
  alignas(64) T blue[places];

  template <class D>
  HWY_INLINE void clear_colours(D d) {
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
      hn::Store(hn::Zero(d), d, red + i);
      hn::Store(hn::Zero(d), d, green + i);
      hn::Store(hn::Zero(d), d, blue + i);
    }
  }
};

/// How finely lines are looked at, by how many there are across a pixel: what a line misses should
/// be no more than what lies between them.
template <typename T>
struct LineGrain {
  T most_span;          ///< in a sphere's radii, between places at which the light is asked for
  T most_turn;          ///< of the normal, in radians, for two points
  T negligible_bend;    ///< of an incidence, for a single one, ...
  T negligible_turn2;   ///< ... and of the normal, squared, as highlights see it
  int secants;          ///< to an edge of light
  T least_pieces = 0;   ///< in a pixel, of two points each, ...
  T pieces_of_clamped;  ///< ... and where colours are clamped

  LineGrain(std::size_t line_count, double shininess) {
    const auto count = static_cast<double>(line_count);
    most_span = static_cast<T>(4.5 / (count * std::sqrt(count)));
    const double highlight = 3.5 / std::sqrt(std::max(1.0, shininess));
    most_turn = static_cast<T>(std::min(1.5, highlight * std::sqrt(12 / count)));
    secants = line_count < 6 ? 1 : line_count < 18 ? 2 : 3;
    negligible_turn2 = shininess > 0 ? static_cast<T>(0.1 / shininess) : T(4);
    negligible_bend = static_cast<T>(0.012 / count);
    pieces_of_clamped = static_cast<T>(1 + count / 2);
  }

  /// For colours that are clamped: where they begin to be is looked at finely, and light is bright
  /// up to its edges.
  LineGrain of_clamped() const {
    LineGrain finer = *this;
    finer.least_pieces = pieces_of_clamped;
    ++finer.secants;
    return finer;
  }
};

/// The rays along lines in the block whose first row's lower left corner is (x, y), y = 0 at the
/// bottom.
template <class D>
class LineRays {
 public:
  using T = hn::TFromD<D>;
  using V = hn::Vec<D>;

  HWY_INLINE LineRays(const EyeRays<D>& eye, double x, double y)
      : steps{eye.step_right(), eye.step_up()}, eye_(eye), x_(x), y_(y) {}

  /// To where lines begin.
  HWY_INLINE V3<V> begin(D d, V right, V down) const {
    return eye_.through(d, x_, y_, right, down);
  }
  /// From there to where they end.
  HWY_INLINE V3<V> step(D d, V is_upright) const {
    return select(hn::Gt(is_upright, hn::Zero(d)), broadcast(d, steps[1]), broadcast(d, steps[0]));
  }
  const SimdScene<T>& scene() const { return eye_.scene(); }

  /// A pixel to the right, and one upwards.
  const std::array<Triple<T>, 2> steps;

 private:
  const EyeRays<D>& eye_;
  double x_;
  double y_;
};

/// Records in columns: put in by some lanes of a packet, and taken out by whole packets once there
/// are enough of them that a processor works on several at a time.
template <class D, std::size_t columns, typename T = hn::TFromD<D>>
struct Queue {
  static constexpr std::size_t lanes = hn::MaxLanes(D());
  static constexpr std::size_t enough = 8 * lanes;
  alignas(64) T values[columns][enough + lanes];
  std::size_t count = 0;

  template <class... Vs>
  HWY_INLINE void push(D d, hn::Mask<D> which, const Vs&... vs) {
    static_assert(sizeof...(vs) == columns);
    std::size_t column = 0;
    (hn::StoreU(hn::Compress(vs, which), d, values[column++] + count), ...);
    count += count_true(d, which);
  }
  bool is_full() const { return count >= enough; }
  HWY_INLINE hn::Vec<D> get(D d, std::size_t column, std::size_t first) const {
    return hn::Load(d, values[column] + first);
  }
  HWY_INLINE hn::Mask<D> active(D d, std::size_t first) const {
    return hn::FirstN(d, count - first);
  }
};

/// The columns of spans: stretches of a line that show one sphere, in pixels of its beginning.
struct SpanColumn {
  enum Name : std::size_t { begin, end, right, down, is_upright, line, sphere, count };
};

/// Those of points of a line, where colours stand for a stretch of it.
struct PointColumn {
  /// `lights` has a bit for each that reaches the point.
  enum Name : std::size_t { at, weight, right, down, is_upright, line, sphere, lights, count };
};

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
