// All samples of a block's pixels, added up.

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

/// Adds to each subtile's error what the means of its half buffers differ by; to each pixel's in
/// linear light.
template <class D, typename T>
HWY_NOINLINE void tell_errors(D d, const Block& block, const BlockRays<D>& rays,
                              const BlockSpread<T>& spread, const BlockColours<T>& sums,
                              const BlockCover<T>* cover, std::size_t count, Transfer transfer,
                              const TileErrors& errors) {
  using V = hn::Vec<D>;
  using Shape = PacketShape<D>;
  const Transfer told_after = errors.pixels != nullptr ? Transfer::linear : transfer;
  for (int i = 0; i < Shape::packets; ++i) {
    const PacketPlace<D> place(i);
    if (!place.is_in(block)) continue;
    const std::size_t first = static_cast<std::size_t>(i) * Shape::lanes;
    V3<V> origin{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    V squares = hn::Zero(d);
    if (errors.pixels != nullptr) {
      origin = load(d, spread.origin, first);
      squares = hn::Load(d, spread.squares + first);
    }
    const V3<V> half_a = load(d, spread.half_a, first);
    const V3<V> all = load(d, sums, first);
    const Spread<V> told =
        cover == nullptr
            ? spread_of(d, half_a, all, origin, squares, count, told_after)
            : spread_of(d, CoveredColour<V>{half_a, hn::Load(d, cover->half_a + first)},
                        CoveredColour<V>{all, hn::Load(d, cover->sum + first)}, origin, squares,
                        count, told_after);
    const auto active = rays.active(d, place);
    const V error2 = hn::IfThenElseZero(active, told.error2);
    if (errors.subtiles != nullptr)
      errors.subtiles->of_block(block.x_begin, block.y_begin)[place.subtile()] +=
          static_cast<double>(hn::GetLane(hn::SumOfLanes(d, error2)));
    if (errors.pixels == nullptr) continue;
    HWY_ALIGN T errors2[Shape::lanes];
    HWY_ALIGN T variances[Shape::lanes];
    hn::Store(error2, d, errors2);
    hn::Store(hn::IfThenElseZero(active, told.variance), d, variances);
    const std::size_t corner =
        errors.pixels->index(block.x_begin + place.x, block.y_begin + place.y);
    for (int lane = 0; lane < Shape::lanes; ++lane)
      errors.pixels->set(corner + errors.pixels->index(lane % Shape::width, lane / Shape::width),
                         {static_cast<float>(errors2[lane]), static_cast<float>(variances[lane])});
  }
}

/// The colours of a block's packets, finished.
template <class D, typename T = hn::TFromD<D>>
struct ResolvedPackets {
  D d;
  const BlockColours<T>& sums;
  hn::Vec<D> share;
  Transfer transfer;

  HWY_INLINE V3<hn::Vec<D>> operator()(int packet) const {
    const std::size_t first = static_cast<std::size_t>(packet) * PacketShape<D>::lanes;
    return resolved(d, load(d, sums, first), share, transfer);
  }
};

/// The same with their cover.
template <class D, typename T = hn::TFromD<D>>
struct ResolvedCover {
  D d;
  const BlockColours<T>& sums;
  const T* cover_sums;
  hn::Vec<D> share;
  Transfer transfer;

  HWY_INLINE CoveredColour<hn::Vec<D>> operator()(int packet) const {
    const std::size_t first = static_cast<std::size_t>(packet) * PacketShape<D>::lanes;
    return resolved(
        d, CoveredColour<hn::Vec<D>>{load(d, sums, first), hn::Load(d, cover_sums + first)}, share,
        transfer);
  }
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

/// What a tile's blocks have in common.
template <typename T>
struct TileTask {
  const PacketScene<T>& scene;
  const SamplePattern& pattern;
  Transfer transfer;
  const Canvas& canvas;
  const TileErrors& errors;
  LightLedger<T>* ledger;
};

/// A block with its samples' colours, as many as have been added.
template <typename T>
class SampledBlock {
  using D = hn::ScalableTag<T>;
  using V = hn::Vec<D>;
  using Shape = PacketShape<D>;

 public:
  SampledBlock(const SampledBlock&) = delete;
  SampledBlock& operator=(const SampledBlock&) = delete;
  SampledBlock(const TileTask<T>& task, const Block& block, const BlockCandidates<T>& candidates,
               std::size_t number)
      : task_(task),
        block_(block),
        candidates_(candidates),
        rays_(D(), task.scene, block, task.pattern.jitter),
        first_pixel_(number * block_pixels),
        has_cover_(has_cover(task.canvas)) {}

  /// A sample of its pixels, but for the rays that follow, which are queued.
  void trace_from_eye(std::size_t sample, RayQueues<T>& queues, SampleColours<T>& colours) {
    // Later samples find in the caches what the first has met.
    const bool fetches = sample == 0 && task_.scene.fetches_light_cells;
    HWY_NAMESPACE::trace_from_eye(D(), rays_.eye, packets(sample), fetches, queues, colours,
                                  cover_of_sample());
  }

  /// Adds the sample once all of it is known.
  void add(std::size_t sample, const SampleColours<T>& colours) {
    const D d;
    const std::size_t count = task_.pattern.points.size();
    if (sample > 0 && sample == task_.pattern.half_a_count) {
      spread_.half_a = sums_;
      if (has_cover_) std::copy_n(cover_.sum, block_pixels, cover_.half_a);
    }
    Highest<D> highest(d);
    for (int packet = 0; packet < Shape::packets; ++packet) {
      if (!PacketPlace<D>(packet).is_in(block_)) continue;
      const std::size_t i = static_cast<std::size_t>(packet) * Shape::lanes;
      const V3<V> colour = load(d, colours, i);
      highest.include(colour);
      const V3<V> seen = clamped(d, colour);
      if (count < many_samples) {
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
      if (task_.errors.pixels == nullptr) continue;
      if (sample == 0) store(d, seen, i, spread_.origin);
      const V3<V> difference = sub(seen, load(d, spread_.origin, i));
      const V before = sample == 0 ? hn::Zero(d) : hn::Load(d, spread_.squares + i);
      hn::Store(hn::Add(before, dot(difference, difference)), d, spread_.squares + i);
    }
    if (HWY_UNLIKELY(highest.is_beyond_range(d)))
      beyond_.note(d, block_, colours,
                   [&](const auto& place) HWY_ATTR { return rays_.active(d, place); });
  }

  /// After the last sample.
  void finish(BeyondRange& beyond) {
    const D d;
    const std::size_t count = task_.pattern.points.size();
    if (task_.errors.are_wanted())
      tell_errors(d, block_, rays_, spread_, sums_, has_cover_ ? &cover_ : nullptr, count,
                  task_.transfer, task_.errors);
    const V share = share_of(d, count);
    store_block(d, ResolvedPackets<D>{d, sums_, share, task_.transfer},
                ResolvedCover<D>{d, sums_, cover_.sum, share, task_.transfer}, block_,
                task_.canvas);
    beyond_.add_to(beyond);
  }

  SamplePackets<D> packets(std::size_t sample) {
    return {rays_,
            candidates_,
            block_,
            task_.pattern.points[sample],
            light_set_of_sample(task_.scene, sample, task_.pattern, task_.ledger),
            first_pixel_};
  }
  /// Which of its rays have met something, if that is wanted.
  T* cover_of_sample() { return has_cover_ ? cover_.sample : nullptr; }

 private:
  const TileTask<T>& task_;
  Block block_;
  BlockCandidates<T> candidates_;
  BlockRays<D> rays_;
  std::size_t first_pixel_;  ///< its number among those that are queued together
  bool has_cover_;
  BlockColours<T> sums_;
  BlockColours<T> rests_;  ///< of many samples
  BlockCover<T> cover_;
  BlockSpread<T> spread_;
  BlockBeyondRange<D> beyond_;
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
