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
#include "engine/kernel/simd/part_pixels-inl.h"
#include "engine/kernel/simd/pixel_edges-inl.h"
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

  static constexpr std::size_t most_pixels = PartPixels<D>::most;
  static constexpr std::size_t places = PartPixels<D>::places;

  enum class Outcome : std::uint8_t { done, nothing_there, not_exact };

  /// Of the block that begins at pixel (x, y), y = 0 on top, and may show `contents`.
  HWY_INLINE PartIntegral(D d, const SimdScene<T>& scene, BlockContents<T>& contents,
                          const LinePattern& pattern, Transfer transfer, int x, int y)
      : contents_(contents),
        eye_(d, scene),
        pattern_(pattern),
        grain_(pattern.count, scene.has_specular ? scene.uniform_shininess : 0),
        evenness_(scene, pattern.negligible_error),
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
    if (!integral_.lit_spans.set(d, spheres_)) return Outcome::not_exact;
    const V half = hn::Set(d, T(0.5));
    pixels_.set(d, pixels, [&](V x, V y) HWY_ATTR {
      return PixelEdges<D>(d, rays_, spheres_, integral_.lit_spans.shadows(), evenness_,
                           rays_.begin(d, hn::Add(x, half), hn::Sub(y, half)));
    });
    pixels_.draw(d, pattern_.count, lines_);
    if (!integral_.run(d)) return Outcome::not_exact;
    if (integral_.clamped_pixels() != 0 && integral_.found_all()) {
      pixels_.make_rough(d);
      pixels_.draw(d, pattern_.count, lines_);
      integral_.run_finely(d);
    }
    resolve(d);
    return Outcome::done;
  }

  /// Whether, in the last run, all edges were found (LineIntegral).
  bool found_all() const { return integral_.found_all(); }

  /// As which of the last run's pixels the k-th of the results was given.
  std::size_t number_of(std::size_t k) const { return pixels_.number_of(k); }

  /// What of the last run's pixels cannot be shown.
  BeyondRange beyond_range() const {
    BeyondRange beyond{.clamped =
                           static_cast<std::size_t>(std::popcount(integral_.clamped_pixels()))};
    for (std::size_t i = 0; i < pixels_.count(); ++i) beyond.not_numbers += is_number(i) ? 0 : 1;
    return beyond;
  }
  bool is_number(std::size_t i) const { return red[i] + green[i] + blue[i] >= 0; }

 private:
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  static constexpr std::size_t lanes = hn::MaxLanes(D());

  HWY_INLINE void resolve(D d) {
    for (std::size_t i = 0; i < pixels_.rough_count(); i += lanes) resolve_rough(d, i);
    for (std::size_t i = pixels_.rough_count(); i < pixels_.count(); i += lanes) resolve_even(d, i);
  }

  /// Pixels of a single line, which errs by a 24th of how they bend (Evenness).
  HWY_INLINE void resolve_even(D d, std::size_t first) {
    const std::size_t line = lines_.rough_end + first - pixels_.rough_count();
    const V3<V> mean{hn::LoadU(d, lines_.red + line), hn::LoadU(d, lines_.green + line),
                     hn::LoadU(d, lines_.blue + line)};
    const V share = hn::MulAdd(pixels_.bend(d, first), hn::Set(d, T(-1.0 / 24)), hn::Set(d, T(1)));
    store(d, first, mean,
          spread_of_means(d, mean, scale(mean, share), T(1), mean, hn::Zero(d), transfer_));
  }

  HWY_INLINE void resolve_rough(D d, std::size_t first) {
    const auto channel = [&](const T* values) HWY_ATTR {
      return means_of(d, pattern_.count, values + first, pixels_.rough_count());
    };
    const LineMeans<V> r = channel(lines_.red);
    const LineMeans<V> g = channel(lines_.green);
    const LineMeans<V> b = channel(lines_.blue);
    const V3<V> mean{r.all, g.all, b.all};
    const V variances = hn::Add(r.variance, hn::Add(g.variance, b.variance));
    Spread<V> spread = spread_of_means(d, V3<V>{r.middles, g.middles, b.middles},
                                       V3<V>{r.others, g.others, b.others}, error2_share_, mean,
                                       variances, transfer_);
    include_unseen(d, mean, pixels_.have_edge(d, first), spread);
    store(d, first, mean, spread);
  }

  HWY_INLINE void store(D d, std::size_t first, const V3<V>& mean, const Spread<V>& spread) {
    const V3<V> seen = resolved(d, mean, hn::Set(d, T(1)), transfer_);
    hn::StoreU(seen.x, d, red + first);
    hn::StoreU(seen.y, d, green + first);
    hn::StoreU(seen.z, d, blue + first);
    hn::StoreU(spread.error2, d, error2 + first);
    hn::StoreU(spread.variance, d, variance + first);
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
  Evenness<T> evenness_;
  Transfer transfer_;
  T error2_share_;
  T unseen_share_;
  int x_;  ///< the lower left corner of the block's first pixel, y = 0 at the bottom
  int y_;
  int part_ = -1;
  LineRays<D> rays_;

 public:
  /// The results, of the pixels in an order of their own.
  alignas(64) T red[places];
  alignas(64) T green[places];
  alignas(64) T blue[places];
  alignas(64) T error2[places];    ///< as PixelSpread
  alignas(64) T variance[places];  ///< likewise

 private:
  PartPixels<D> pixels_;
  PartSpheres<T> spheres_;
  Lines<T> lines_;
  LineIntegral<D> integral_;
};

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
