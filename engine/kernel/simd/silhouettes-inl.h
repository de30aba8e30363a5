// Where lines enter and leave the silhouettes of spheres.
//
// A silhouette is a conic on the image, and a line's crossings with it the roots of a quadratic.
// Between all of them the line shows the nearest of the spheres that it is inside of.

#if defined(RAYTRACER_KERNEL_SIMD_SILHOUETTES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_SILHOUETTES_INL_H_
#undef RAYTRACER_KERNEL_SIMD_SILHOUETTES_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_SILHOUETTES_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "engine/kernel/simd/lines-inl.h"
#include "engine/kernel/simd/part_spheres-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

template <class D>
class Silhouettes {
 public:
  using T = hn::TFromD<D>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  explicit HWY_INLINE Silhouettes(const LineRays<D>& rays) : rays_(rays) {}

  /// These are the spheres that lines may show. False where one of them is so near that a line may
  /// enter its silhouette twice.
  HWY_INLINE bool set(const PartSpheres<T>& spheres, T most_span) {
    for (std::size_t j = 0; j < spheres.count; ++j) {
      for (std::size_t k = 0; k < rays_.steps.size(); ++k)
        if (!note_turn(spheres, j, k)) return false;
      note_most_span(spheres, most_span, j);
    }
    return true;
  }

  /// Calls take(lanes, values of SpanColumn ...) for the spans of the packet of lines that begins
  /// at `first`, and adds the background's share to their colours.
  template <class Take>
  HWY_INLINE void cross(D d, const PartSpheres<T>& spheres, std::size_t first, Lines<T>& lines,
                        const Take& take) const {
    const V zero = hn::Zero(d);
    const V one = hn::Set(d, T(1));
    const V right = hn::Load(d, lines.right + first);
    const V down = hn::Load(d, lines.down + first);
    const V is_upright = hn::Load(d, lines.is_upright + first);
    const M upright = hn::Gt(is_upright, zero);
    const V3<V> from = rays_.begin(d, right, down);
    const V3<V> step = rays_.step(d, is_upright);
    const V from_from = dot(from, from);
    const V from_step = dot(from, step);
    // The ray from + x step is inside where |c x (from + x step)|^2 <= r^2 |from + x step|^2.
    alignas(64) T entries[S::most][lanes];
    alignas(64) T exits[S::most][lanes];
    const std::size_t count = spheres.count;
    for (std::size_t j = 0; j < count; ++j) {
      const auto all = [&](typename S::Value value)
                           HWY_ATTR { return hn::Set(d, spheres.values[value][j]); };
      const V3<V> c{all(S::x), all(S::y), all(S::z)};
      const V r2 = all(S::radius2);
      const V3<V> turn{hn::MulSub(c.y, from.z, hn::Mul(c.z, from.y)),
                       hn::MulSub(c.z, from.x, hn::Mul(c.x, from.z)),
                       hn::MulSub(c.x, from.y, hn::Mul(c.y, from.x))};
      const V3<V> step_turn =
          select(upright, broadcast(d, turns_[j].across[1]), broadcast(d, turns_[j].across[0]));
      const V square =
          hn::IfThenElse(upright, hn::Set(d, turns_[j].square[1]), hn::Set(d, turns_[j].square[0]));
      const V half_slope = hn::NegMulAdd(r2, from_step, dot(turn, step_turn));
      const V constant = hn::NegMulAdd(r2, from_from, dot(turn, turn));
      const V discriminant = hn::MulSub(half_slope, half_slope, hn::Mul(square, constant));
      const V root = hn::Sqrt(hn::Max(discriminant, zero));
      const V inverse_square = inverse(d, square);
      const V entry = hn::Max(hn::Mul(hn::Neg(hn::Add(half_slope, root)), inverse_square), zero);
      const V exit = hn::Min(hn::Mul(hn::Sub(root, half_slope), inverse_square), one);
      // The cone goes on behind the eye.
      const M is_ahead = hn::Gt(hn::MulAdd(dot(c, step), entry, dot(c, from)), zero);
      const M is_crossed =
          hn::And(is_ahead, hn::And(hn::Gt(discriminant, zero), hn::Lt(entry, exit)));
      const V never = hn::Set(d, T(2));
      hn::Store(hn::IfThenElse(is_crossed, entry, never), d, entries[j]);
      hn::Store(hn::IfThenElse(is_crossed, exit, never), d, exits[j]);
    }

    const V line = hn::Iota(d, static_cast<T>(first));
    V background = zero;
    V x = zero;
    M active = hn::FirstN(d, lines.count - first);
    while (!hn::AllFalse(d, active)) {
      // From far to near: a nearer sphere hides what is behind it, and ends it where it begins.
      V end = one;
      V sphere = hn::Set(d, T(-1));
      V most_span = one;
      for (std::size_t j = count; j-- > 0;) {
        const V entry = hn::Load(d, entries[j]);
        const V exit = hn::Load(d, exits[j]);
        const M is_ahead = hn::Gt(entry, x);
        const M is_inside = hn::AndNot(is_ahead, hn::Gt(exit, x));
        end = hn::IfThenElse(is_ahead, hn::Min(end, entry), end);
        end = hn::IfThenElse(is_inside, exit, end);
        sphere = hn::IfThenElse(is_inside, hn::Set(d, static_cast<T>(j)), sphere);
        most_span = hn::IfThenElse(is_inside, hn::Set(d, most_spans_[j]), most_span);
      }
      end = hn::Min(end, hn::Add(x, most_span));
      const V width = hn::Sub(end, x);
      const M shows = hn::Ge(sphere, zero);
      background = hn::Add(background, hn::IfThenElseZero(hn::AndNot(shows, active), width));
      const M is_span = hn::And(active, shows);
      if (!hn::AllFalse(d, is_span)) take(is_span, x, end, right, down, is_upright, line, sphere);
      x = end;
      active = hn::And(active, hn::Lt(x, one));
    }
    const V3<V> seen = clamped(d, broadcast(d, rays_.scene().background));
    const auto add_to = [&](T* sums, V channel) HWY_ATTR {
      hn::Store(hn::MulAdd(background, channel, hn::Load(d, sums + first)), d, sums + first);
    };
    add_to(lines.red, seen.x);
    add_to(lines.green, seen.y);
    add_to(lines.blue, seen.z);
  }

 private:
  using S = PartSpheres<T>;
  static constexpr std::size_t lanes = hn::MaxLanes(D());

  /// A sphere's centre, vectorially times the lines' steps, and the coefficients of x^2 in what is
  /// positive between the roots.
  struct Turn {
    std::array<Triple<T>, 2> across;
    std::array<T, 2> square;
  };

  bool note_turn(const PartSpheres<T>& spheres, std::size_t sphere, std::size_t step_index) {
    const auto& v = spheres.values;
    const Triple<T> c{v[S::x][sphere], v[S::y][sphere], v[S::z][sphere]};
    const Triple<T>& step = rays_.steps[step_index];
    const Triple<T> turn{c.y * step.z - c.z * step.y, c.z * step.x - c.x * step.z,
                         c.x * step.y - c.y * step.x};
    const auto length2 = [](const Triple<T>& a) { return a.x * a.x + a.y * a.y + a.z * a.z; };
    const T square = length2(turn) - v[S::radius2][sphere] * length2(step);
    turns_[sphere].across[step_index] = turn;
    turns_[sphere].square[step_index] = square;
    return square > 0;
  }

  void note_most_span(const PartSpheres<T>& spheres, T most_span, std::size_t sphere) {
    const auto& v = spheres.values;
    const T distance2 = v[S::eye_c][sphere] + v[S::radius2][sphere];
    const Triple<T>& step = rays_.steps[0];
    const T pixel2 = step.x * step.x + step.y * step.y + step.z * step.z;
    // A line of specks is not to take ever so many steps.
    constexpr T least = T(1e-3);
    const T radius = std::sqrt(v[S::radius2][sphere] / (distance2 * pixel2));
    most_spans_[sphere] = std::max(most_span * radius, least);
  }

  const LineRays<D>& rays_;
  std::array<Turn, S::most> turns_;
  std::array<T, S::most> most_spans_;  ///< of the spheres, in pixels
};

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
