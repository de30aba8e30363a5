// Pixels of a part of a block, integrated along lines.

#if defined(RAYTRACER_KERNEL_SIMD_PART_INTEGRAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_PART_INTEGRAL_INL_H_
#undef RAYTRACER_KERNEL_SIMD_PART_INTEGRAL_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_PART_INTEGRAL_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/kernel/beyond_range.h"
#include "engine/kernel/line_pattern.h"
#include "engine/kernel/simd/line_integral-inl.h"
#include "engine/kernel/simd/resolve-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// What a pixel's lines come to, of one channel.
template <class V>
struct LineMeans {
  V all;
  V middles;   ///< of the middle ones of each three
  V others;    ///< of the others
  V variance;  ///< about a slope
};

/// Of a packet of pixels that begins at `values`, `stride` from line to line.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE LineMeans<V> means_of(D d, std::size_t count, const T* values, std::size_t stride) {
  // Of differences from one of them: squares of what is large leave nothing of what is small.
  const V origin = hn::LoadU(d, values + count / 2 * stride);
  const T middle = static_cast<T>(count - 1) / 2;
  V middles = hn::Zero(d);
  V others = middles;
  V squares = middles;
  V slope = middles;
  for (std::size_t k = 0; k < count; ++k) {
    const V value = hn::Sub(hn::LoadU(d, values + k * stride), origin);
    V& sum = k % 3 == 1 ? middles : others;
    sum = hn::Add(sum, value);
    squares = hn::MulAdd(value, value, squares);
    slope = hn::MulAdd(hn::Set(d, static_cast<T>(k) - middle), value, slope);
  }
  const auto times = [&](V a, T factor) HWY_ATTR { return hn::Mul(a, hn::Set(d, factor)); };
  const T share = 1 / static_cast<T>(count);
  const V mean = times(hn::Add(middles, others), share);
  const V along = times(slope, share);
  const T places = static_cast<T>(count * count - 1) / 12;  // the variance of 0 to count - 1
  const V of_slope = hn::Mul(along, times(along, 1 / places));
  const V variance = hn::Sub(hn::NegMulAdd(mean, mean, times(squares, share)), of_slope);
  return {hn::Add(mean, origin), hn::Add(times(middles, 3 * share), origin),
          hn::Add(times(others, T(1.5) * share), origin), variance};
}

/// What share of the squared difference of the middle lines from the others a pixel's squared error
/// probably is. With a third of the lines it is 3^3 times as much, and the middle ones are off by
/// 3/2 of it from the others where the whole is not. Many lines have errors along them in common,
/// which do not show: of 12 to 48 lines on spheres of 35 pixels, twice what the difference says.
inline double error2_share(std::size_t line_count) {
  constexpr double few = 9;
  const double unseen = std::pow(std::max(1.0, static_cast<double>(line_count) / few), 0.8);
  return unseen / (27 * 2.25);
}

/// What lines may leave out of a pixel that an edge crosses, and no difference between them tells:
/// a corner beside the first or the last line, of up to (2 n)^-2 / 2 of the pixel. A sixth of that:
/// of 5,997 contracts on random scenes 18 are missed then, and 37 without.
inline double unseen_share(std::size_t line_count) {
  const auto count = static_cast<double>(line_count);
  return 0.02 / (count * count);
}

// The rays are made before the integral that needs them, whose columns begin at multiples of 64.
template <class D>
class PartIntegral {  // NOLINT(clang-analyzer-optin.performance.Padding)
 public:
  using T = hn::TFromD<D>;

  static constexpr std::size_t most_pixels = std::size_t{part_side} * part_side;
  static constexpr std::size_t places = most_pixels + 16;

  enum class Outcome : std::uint8_t { done, nothing_there, not_exact };

  /// Of the block that begins at pixel (x, y), y = 0 on top, and may show `contents`.
  HWY_INLINE PartIntegral(D d, const SimdScene<T>& scene, BlockContents<T>& contents,
                          const LinePattern& pattern, Transfer transfer, int x, int y)
      : contents_(contents),
        eye_(d, scene),
        pattern_(pattern),
        grain_(pattern.count, scene.has_specular ? scene.uniform_shininess : 0),
        transfer_(transfer),
        error2_share_(static_cast<T>(error2_share(pattern.count))),
        unseen_share_(static_cast<T>(unseen_share(pattern.count))),
        x_(x),
        y_(scene.view.height - 1 - y),
        rays_(eye_, x_, y_),
        integral_(rays_, grain_, spheres_, lines_) {}

  /// How many pixels may be integrated at a time.
  std::size_t pixels_at_once() const {
    return std::clamp<std::size_t>(Lines<T>::most / pattern_.count, 1, most_pixels);
  }

  /// Integrates pixels of a part, by their places in the block: column + block_side * row.
  HWY_INLINE Outcome run(D d, int part, std::span<const std::uint8_t> pixels) {
    if ((contents_.parts >> part & 1U) == 0) return Outcome::nothing_there;
    if (part != part_) {
      part_ = part;
      const int part_x = part % parts_across * part_side;
      const int part_y = part / parts_across * part_side;
      find_part_spheres(d, eye_, PartContents<T>{contents_, part}, x_ + part_x,
                        y_ + 1 - part_y - part_side, spheres_);
    }
    if (!spheres_.are_all) return Outcome::not_exact;
    if (spheres_.count == 0) return Outcome::nothing_there;
    count_ = pixels.size();
    for (std::size_t i = 0; i < count_; ++i) {
      const int x = pixels[i] % block_side;
      const int y = pixels[i] / block_side;
      column_[i] = static_cast<T>(x);
      low_[i] = static_cast<T>(y);
    }
    if (!integral_.lit_spans.set(d, spheres_)) return Outcome::not_exact;
    turn_lines(d);
    draw_lines(d);
    if (!integral_.run(d)) return Outcome::not_exact;
    for (std::size_t i = 0; i < count_; i += lanes) resolve(d, i);
    return Outcome::done;
  }

  /// Whether, in the last run, all edges were found (LineIntegral).
  bool found_all() const { return integral_.found_all(); }

  /// What of the last run's pixels cannot be shown.
  BeyondRange beyond_range() const {
    BeyondRange beyond{.clamped =
                           static_cast<std::size_t>(std::popcount(integral_.clamped_pixels()))};
    for (std::size_t i = 0; i < count_; ++i) beyond.not_numbers += is_number(i) ? 0 : 1;
    return beyond;
  }
  bool is_number(std::size_t i) const { return red[i] + green[i] + blue[i] >= 0; }

 private:
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  using S = PartSpheres<T>;
  static constexpr std::size_t lanes = hn::MaxLanes(D());

  /// Which way each pixel's lines go: across the silhouettes that pass it. Those along a line move
  /// it from one side to the other at once, and only many lines see how far.
  HWY_INLINE void turn_lines(D d) {
    const Triple<T> right = rays_.steps[0];
    const Triple<T> up = rays_.steps[1];
    const T pixel = std::sqrt(right.x * right.x + right.y * right.y + right.z * right.z);
    const V half = hn::Set(d, T(0.5));
    const V zero = hn::Zero(d);
    for (std::size_t i = 0; i < count_; i += lanes) {
      const V3<V> through = rays_.begin(d, hn::Add(hn::Load(d, column_ + i), half),
                                        hn::Sub(hn::Load(d, low_ + i), half));
      const V nearer = inverse_root(d, dot(through, through));
      const V3<V> direction = scale(through, nearer);
      // Half a pixel's diagonal at a distance of 1.
      const V reach = hn::Mul(hn::Set(d, T(0.71) * pixel), nearer);
      V upright = zero;
      V level = zero;
      M is_open = hn::Eq(zero, zero);
      V front = hn::Set(d, T(-1));
      for (std::size_t j = 0; j < spheres_.count && !hn::AllFalse(d, is_open); ++j) {
        const auto all = [&](typename S::Value value)
                             HWY_ATTR { return hn::Set(d, spheres_.values[value][j]); };
        const V3<V> c{all(S::x), all(S::y), all(S::z)};
        const V b = dot(c, direction);
        const V3<V> l = mul_add(direction, hn::Neg(b), c);
        const V beyond = hn::Sub(dot(l, l), all(S::radius2));
        front = hn::IfThenElse(hn::And(hn::Lt(front, zero), hn::Lt(beyond, zero)),
                               hn::Set(d, static_cast<T>(j)), front);
        const V near = hn::Mul(reach, b);
        const V radius = hn::Mul(all(S::radius2), all(S::curvature));
        const V width = hn::Mul(near, hn::MulAdd(hn::Set(d, T(2)), radius, near));
        const M is_silhouette =
            hn::And(hn::And(is_open, hn::Gt(b, zero)), hn::Lt(hn::Abs(beyond), width));
        weigh_edge(d, is_silhouette, dot(l, broadcast(d, right)), dot(l, broadcast(d, up)), upright,
                   level);
        // What is behind a sphere that covers the pixel is not seen.
        is_open = hn::AndNot(hn::Lt(beyond, hn::Neg(width)), is_open);
      }
      const M shows = hn::And(hn::FirstN(d, count_ - i), hn::Ge(front, zero));
      integral_.lit_spans.weigh_edges(d, spheres_, through, front, shows, upright, level);
      const V turned = hn::IfThenElseZero(hn::Gt(level, upright), hn::Set(d, T(1)));
      hn::Store(turned, d, is_upright_ + i);
      hn::Store(hn::Add(upright, level), d, edges_ + i);
    }
  }

  /// One line of each pixel after another.
  HWY_INLINE void draw_lines(D d) {
    const V half = hn::Set(d, T(0.5));
    lines_.count = 0;
    lines_.pixel_count = count_;
    for (std::size_t k = 0; k < pattern_.count; ++k) {
      const double place = (static_cast<double>(k) + 0.5) / static_cast<double>(pattern_.count);
      const V from_middle = hn::Set(d, static_cast<T>(place - 0.5));
      for (std::size_t i = 0; i < count_; i += lanes) {
        const V x = hn::Load(d, column_ + i);
        const V y = hn::Load(d, low_ + i);
        const V is_upright = hn::Load(d, is_upright_ + i);
        const M upright = hn::Gt(is_upright, hn::Zero(d));
        const V right = hn::IfThenElse(upright, hn::Add(hn::Add(x, half), from_middle), x);
        const V down = hn::IfThenElse(upright, y, hn::Sub(hn::Sub(y, half), from_middle));
        const std::size_t to = lines_.count + i;
        hn::StoreU(right, d, lines_.right + to);
        hn::StoreU(down, d, lines_.down + to);
        hn::StoreU(is_upright, d, lines_.is_upright + to);
      }
      lines_.count += count_;
    }
  }

  HWY_INLINE void resolve(D d, std::size_t first) {
    const auto channel = [&](const T* values) HWY_ATTR {
      return means_of(d, pattern_.count, values + first, count_);
    };
    const LineMeans<V> r = channel(lines_.red);
    const LineMeans<V> g = channel(lines_.green);
    const LineMeans<V> b = channel(lines_.blue);
    const V3<V> mean{r.all, g.all, b.all};
    const V variances = hn::Add(r.variance, hn::Add(g.variance, b.variance));
    Spread<V> spread = spread_of_means(d, V3<V>{r.middles, g.middles, b.middles},
                                       V3<V>{r.others, g.others, b.others}, error2_share_, mean,
                                       variances, transfer_);
    include_unseen(d, mean, hn::Gt(hn::Load(d, edges_ + first), hn::Zero(d)), spread);
    const V3<V> seen = resolved(d, mean, hn::Set(d, T(1)), transfer_);
    hn::Store(seen.x, d, red + first);
    hn::Store(seen.y, d, green + first);
    hn::Store(seen.z, d, blue + first);
    hn::Store(spread.error2, d, error2 + first);
    hn::Store(spread.variance, d, variance + first);
  }

  /// Where lines differ by less, what they may all have passed by counts.
  HWY_INLINE void include_unseen(D d, const V3<V>& mean, M has_edge, Spread<V>& spread) const {
    const V zero = hn::Zero(d);
    const auto beside_it = [&](V channel) HWY_ATTR {  // nothing is brighter than 1
      const V share = hn::IfThenElseZero(has_edge, hn::Set(d, unseen_share_));
      const M is_bright = hn::Gt(channel, hn::Set(d, T(0.5)));
      return hn::IfThenElse(is_bright, hn::Sub(channel, share), hn::Add(channel, share));
    };
    const V3<V> beside{beside_it(mean.x), beside_it(mean.y), beside_it(mean.z)};
    const V unseen2 = spread_of_means(d, mean, beside, T(1), mean, zero, transfer_).error2;
    const auto count = static_cast<T>(pattern_.count);
    const V of_one = hn::Mul(unseen2, hn::Set(d, count * count * count));  // as a variance
    const M counts = hn::Lt(spread.error2, unseen2);
    spread.error2 = hn::Max(spread.error2, unseen2);
    spread.variance = hn::IfThenElse(counts, hn::Max(spread.variance, of_one), spread.variance);
  }

  BlockContents<T>& contents_;
  EyeRays<D> eye_;
  LinePattern pattern_;
  LineGrain<T> grain_;
  Transfer transfer_;
  T error2_share_;
  T unseen_share_;
  int x_;  ///< the lower left corner of the block's first pixel, y = 0 at the bottom
  int y_;
  int part_ = -1;
  std::size_t count_ = 0;
  LineRays<D> rays_;

 public:
  /// Of the pixels in their order.
  alignas(64) T red[places];
  alignas(64) T green[places];
  alignas(64) T blue[places];
  alignas(64) T error2[places];    ///< as PixelSpread
  alignas(64) T variance[places];  ///< likewise

 private:
  alignas(64) T column_[places] = {};  ///< of the pixels
  alignas(64) T low_[places] = {};     ///< how far their lower sides are below the first row's
  alignas(64) T is_upright_[places];
  alignas(64) T edges_[places];  ///< above 0 where one may cross the pixel
  PartSpheres<T> spheres_;
  Lines<T> lines_;
  LineIntegral<D> integral_;
};

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
