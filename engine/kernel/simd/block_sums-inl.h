// Sums over the samples of a block's pixels.

#include <algorithm>
#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Sums over a block's pixels, in addition to their colours', that tell their errors.
template <typename T>
struct BlockSpread {
  BlockColours<T> half_a;               ///< of half buffer A
  BlockColours<T> origin;               ///< a sample
  alignas(64) T squares[block_pixels];  ///< of the others' differences from it
};

/// Which of a block's samples have met something, as 1, else 0; where the image has a cover.
template <typename T>
struct BlockCover {
  alignas(64) T sample[block_pixels];
  alignas(64) T sum[block_pixels];
  alignas(64) T half_a[block_pixels];  ///< the sum over half buffer A
};

/// From so many samples on their sums in singles would lose what is equal in all of them: 65,536 of
/// 0.53 came to 5e-4 less than that many times it. What an addition rounds off is then kept for the
/// next (W. Kahan, Further remarks on reducing truncation errors, 1965).
inline constexpr std::size_t many_samples = 65;

/// Adds a sample to a sum of many, and leaves what was rounded off.
template <class V>
HWY_INLINE V3<V> add_with_rest(const V3<V>& sum, const V3<V>& sample, V3<V>& rest) {
  const V3<V> more = sub(sample, rest);
  const V3<V> result = add(sum, more);
  rest = sub(sub(result, sum), more);
  return result;
}

/// As many samples as have been added.
template <class D, typename T = hn::TFromD<D>>
class BlockSums {
  using V = hn::Vec<D>;
  using Shape = PacketShape<D>;

 public:
  /// `tells_spread`: of each pixel, if the pattern has half buffers.
  HWY_INLINE BlockSums(const SamplePattern& pattern, bool has_cover, bool tells_spread)
      : count_(pattern.points.size()),
        half_a_count_(pattern.half_a_count),
        has_cover_(has_cover),
        tells_spread_(tells_spread) {}

  /// Adds the nth sample of the block's pixels.
  HWY_INLINE void add(D d, std::size_t sample, const Block& block, const BlockRays<D>& rays,
                      const SampleColours<T>& colours) {
    if (sample > 0 && sample == half_a_count_) {
      spread_.half_a = sums_;
      if (has_cover_) std::copy_n(cover_.sum, block_pixels, cover_.half_a);
    }
    Highest<D> highest(d);
    for (int packet = 0; packet < Shape::packets; ++packet) {
      if (!PacketPlace<D>(packet).is_in(block)) continue;
      const std::size_t i = static_cast<std::size_t>(packet) * Shape::lanes;
      const V3<V> colour = load(d, colours, i);
      highest.include(colour);
      const V3<V> seen = clamped(d, colour);
      if (count_ < many_samples) {
        store(d, sample == 0 ? seen : HWY_NAMESPACE::add(seen, load(d, sums_, i)), i, sums_);
      } else {
        const V zero = hn::Zero(d);
        V3<V> rest{zero, zero, zero};
        if (sample > 0) rest = load(d, rests_, i);
        store(d, sample == 0 ? seen : add_with_rest(load(d, sums_, i), seen, rest), i, sums_);
        store(d, rest, i, rests_);
      }
      if (has_cover_) {
        const V hits = hn::Load(d, cover_.sample + i);
        hn::Store(sample == 0 ? hits : hn::Add(hits, hn::Load(d, cover_.sum + i)), d,
                  cover_.sum + i);
      }
      if (!tells_spread_) continue;
      if (sample == 0) store(d, seen, i, spread_.origin);
      const V3<V> difference = sub(seen, load(d, spread_.origin, i));
      const V before = sample == 0 ? hn::Zero(d) : hn::Load(d, spread_.squares + i);
      hn::Store(hn::Add(before, dot(difference, difference)), d, spread_.squares + i);
    }
    if (HWY_UNLIKELY(highest.is_beyond_range(d)))
      beyond_.note(d, block, colours,
                   [&](const auto& place) HWY_ATTR { return rays.active(d, place); });
  }

  /// Which rays of the sample that is added next have met something, as 1, else 0; null if that is
  /// not wanted.
  T* cover_of_sample() { return has_cover_ ? cover_.sample : nullptr; }

  /// What the packet of pixels from the at-th on tells of errors; of the variance only if
  /// `tells_spread`.
  HWY_INLINE Spread<V> spread(D d, std::size_t at, Transfer transfer) const {
    V3<V> origin{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    V squares = hn::Zero(d);
    if (tells_spread_) {
      origin = load(d, spread_.origin, at);
      squares = hn::Load(d, spread_.squares + at);
    }
    const V3<V> half_a = load(d, spread_.half_a, at);
    const V3<V> all = load(d, sums_, at);
    if (!has_cover_) return spread_of(d, half_a, all, origin, squares, count_, transfer);
    return spread_of(d, CoveredColour<V>{half_a, hn::Load(d, cover_.half_a + at)},
                     CoveredColour<V>{all, hn::Load(d, cover_.sum + at)}, origin, squares, count_,
                     transfer);
  }

  /// The means of the packet from the at-th on.
  HWY_INLINE V3<V> mean(D d, std::size_t at, Transfer transfer) const {
    return resolved(d, load(d, sums_, at), share_of(d, count_), transfer);
  }
  /// The same where there is a cover.
  HWY_INLINE CoveredColour<V> covered_mean(D d, std::size_t at, Transfer transfer) const {
    const CoveredColour<V> sum{load(d, sums_, at), hn::Load(d, cover_.sum + at)};
    return resolved(d, sum, share_of(d, count_), transfer);
  }

  bool has_cover() const { return has_cover_; }
  const BlockBeyondRange<D>& beyond() const { return beyond_; }

 private:
  std::size_t count_;
  std::size_t half_a_count_;
  bool has_cover_;
  bool tells_spread_;
  BlockColours<T> sums_;
  BlockColours<T> rests_;  ///< of many samples
  BlockCover<T> cover_;
  BlockSpread<T> spread_;
  BlockBeyondRange<D> beyond_;
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
