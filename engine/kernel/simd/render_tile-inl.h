// Tiles of an image: all samples of a block's pixels.

#include <algorithm>

#include "engine/kernel/simd/render_tile.h"
#include "engine/lights/light_places.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// The rays from the eye through a block's pixels.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
class BlockRays {
 public:
  HWY_INLINE BlockRays(D d, const PacketScene<T>& scene, const Block& block, double jitter)
      : eye(d, scene), block_(block), offsets_(d), jitter_(jitter), height_(scene.view.height) {}

  /// Through `sample` of the packet's pixels.
  HWY_INLINE V3<V> direction(D d, const PacketPlace<D>& place, const SamplePoint& sample) const {
    V right = offsets_.x;
    V down = offsets_.y;
    if (jitter_ > 0) {
      const Jitters<D> jitters(d, place);
      const auto across = static_cast<T>(away_from_middle(sample.x, jitter_));
      const auto up = static_cast<T>(away_from_middle(sample.y, jitter_));
      right = hn::MulAdd(jitters.x, hn::Set(d, across), right);
      down = hn::NegMulAdd(jitters.y, hn::Set(d, up), down);
    }
    return eye.direction(d, block_.x_begin + place.x + sample.x,
                         height_ - 1 - block_.y_begin - place.y + sample.y, right, down);
  }

  /// As direction()'s, of one pixel: from the image's lower left corner, in pixels.
  HWY_INLINE SamplePoint image_point(const PixelPlace<D>& pixel, const SamplePoint& sample) const {
    const SamplePoint moved = jitter_of(pixel.x, pixel.y);
    return {block_.x_begin + pixel.x + sample.x + away_from_middle(sample.x, jitter_) * moved.x,
            height_ - 1 - block_.y_begin - pixel.y + sample.y +
                away_from_middle(sample.y, jitter_) * moved.y};
  }

  /// The lanes whose pixels are in the block.
  HWY_INLINE hn::Mask<D> active(D d, const PacketPlace<D>& place) const {
    return hn::And(hn::Lt(offsets_.x, hn::Set(d, static_cast<T>(block_.width - place.x))),
                   hn::Lt(offsets_.y, hn::Set(d, static_cast<T>(block_.height - place.y))));
  }

  const EyeRays<D> eye;

 private:
  const Block& block_;
  LaneOffsets<D> offsets_;
  double jitter_;
  int height_;
};

/// A block's packets at one sample's place.
template <class D, typename T = hn::TFromD<D>>
class SamplePackets {
 public:
  HWY_INLINE SamplePackets(const BlockRays<D>& rays, BlockCandidates<T>& candidates,
                           const Block& block, const SamplePoint& sample,
                           const LightSet<T>& light_set)
      : rays_(rays),
        candidates_(candidates),
        block_(block),
        sample_(sample),
        light_set_(light_set) {}

  static constexpr int count() { return PacketShape<D>::packets; }
  /// Pixels differ from each other by their place in a square of 2 x 2, if there are several sets.
  HWY_INLINE LightSets<T> light_sets() const {
    LightSets<T> sets(light_set_);
    const int count = rays_.eye.scene().light_sets;
    sets.differ = count > 1;
    const int sample = static_cast<int>(light_set_.index);
    for (int i = 0; i < 4; ++i)
      sets.of_quarters[i].index =
          static_cast<std::size_t>(light_set_of(i % 2, i / 2, sample, count));
    return sets;
  }
  HWY_INLINE bool is_in(int i) const { return PacketPlace<D>(i).is_in(block_); }
  HWY_INLINE SubtileCandidates<T> candidates(int i) const {
    return {candidates_, PacketPlace<D>(i).subtile()};
  }
  HWY_INLINE V3<hn::Vec<D>> direction(D d, int i) const {
    return rays_.direction(d, PacketPlace<D>(i), sample_);
  }
  HWY_INLINE hn::Mask<D> active(D d, int i) const { return rays_.active(d, PacketPlace<D>(i)); }
  HWY_INLINE SamplePoint image_point(int ray) const {
    return rays_.image_point(PixelPlace<D>(ray), sample_);
  }

 private:
  const BlockRays<D>& rays_;
  BlockCandidates<T>& candidates_;
  const Block& block_;
  const SamplePoint& sample_;
  LightSet<T> light_set_;
};

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

/// The colour of a pixel that shows nothing, with the roundings of one whose rays were traced.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V3<V> resolved_background(D d, const PacketScene<T>& scene, std::size_t sample_count,
                                     Transfer transfer) {
  const V3<V> sample = clamped(d, broadcast(d, scene.background));
  const V zero = hn::Zero(d);
  V3<V> sum = sample;
  V3<V> rest{zero, zero, zero};
  for (std::size_t i = 1; i < sample_count; ++i)
    sum = sample_count < many_samples ? add(sample, sum) : add_with_rest(sum, sample, rest);
  return resolved(d, sum, share_of(d, sample_count), transfer);
}

template <typename T>
void render_block(const PacketScene<T>& scene, const SamplePattern& pattern, Transfer transfer,
                  const Block& whole, const SolidRow& background, const Canvas& canvas,
                  const TileErrors& errors, RayQueues<T>& queues, LightLedger<T>* ledger,
                  BlockSpread<T>& spread, BeyondRange& beyond) {
  using D = hn::ScalableTag<T>;
  const D d;
  using V = hn::Vec<D>;
  using Shape = PacketShape<D>;
  BlockCandidates<T> candidates(scene, whole.x_begin / block_side, whole.y_begin / block_side);
  Block block = whole;
  block.subtiles &= candidates.subtiles;
  if (block.subtiles != whole.subtiles)
    fill_subtiles(background, whole, whole.subtiles & ~candidates.subtiles, canvas);
  if (block.subtiles == 0) return;

  const BlockRays<D> rays(d, scene, block, pattern.jitter);
  const bool spreads = errors.pixels != nullptr;
  BlockColours<T> sums;
  BlockColours<T> rests;  // of many samples
  SampleColours<T> colours;
  BlockCover<T> covers;
  BlockCover<T>* const cover = has_cover(canvas) ? &covers : nullptr;
  BlockBeyondRange<D> block_beyond;
  for (std::size_t sample = 0; sample < pattern.points.size(); ++sample) {
    if (sample > 0 && sample == pattern.half_a_count) {
      spread.half_a = sums;
      if (cover != nullptr) std::copy_n(cover->sum, block_pixels, cover->half_a);
    }
    // Later samples find in the caches what the first has met.
    const bool fetches = sample == 0 && scene.fetches_light_cells;
    trace_packets(d, rays.eye,
                  SamplePackets<D>(rays, candidates, block, pattern.points[sample],
                                   {sample % static_cast<std::size_t>(scene.light_sets), ledger}),
                  fetches, queues, colours, cover != nullptr ? cover->sample : nullptr);
    Highest<D> highest(d);
    for (int packet = 0; packet < Shape::packets; ++packet) {
      if (!PacketPlace<D>(packet).is_in(block)) continue;
      const std::size_t i = static_cast<std::size_t>(packet) * Shape::lanes;
      const V3<V> colour = load(d, colours, i);
      highest.include(colour);
      const V3<V> seen = clamped(d, colour);
      if (pattern.points.size() < many_samples) {
        store(d, sample == 0 ? seen : add(seen, load(d, sums, i)), i, sums);
      } else {
        const V zero = hn::Zero(d);
        V3<V> rest{zero, zero, zero};
        if (sample > 0) rest = load(d, rests, i);
        store(d, sample == 0 ? seen : add_with_rest(load(d, sums, i), seen, rest), i, sums);
        store(d, rest, i, rests);
      }
      if (cover != nullptr) {
        const V hits = hn::Load(d, cover->sample + i);
        hn::Store(sample == 0 ? hits : hn::Add(hits, hn::Load(d, cover->sum + i)), d,
                  cover->sum + i);
      }
      if (!spreads) continue;
      if (sample == 0) store(d, seen, i, spread.origin);
      const V3<V> difference = sub(seen, load(d, spread.origin, i));
      const V before = sample == 0 ? hn::Zero(d) : hn::Load(d, spread.squares + i);
      hn::Store(hn::Add(before, dot(difference, difference)), d, spread.squares + i);
    }
    if (HWY_UNLIKELY(highest.is_beyond_range(d)))
      block_beyond.note(d, block, colours,
                        [&](const auto& place) HWY_ATTR { return rays.active(d, place); });
  }
  if (errors.are_wanted())
    tell_errors(d, block, rays, spread, sums, cover, pattern.points.size(), transfer, errors);
  const hn::Vec<D> share = share_of(d, pattern.points.size());
  store_block(d, ResolvedPackets<D>{d, sums, share, transfer},
              ResolvedCover<D>{d, sums, covers.sum, share, transfer}, block, canvas);
  block_beyond.add_to(beyond);
}

template <typename T>
TracedTile render_blocks(const PacketScene<T>& scene, const SamplePattern& pattern,
                         Transfer transfer, const Tile& tile, const Canvas& canvas,
                         const TileErrors& errors, LightLedger<T>* ledger) {
  TracedTile traced{HWY_TARGET, {}};
  const hn::ScalableTag<T> d;
  const SolidRow background(d, resolved_background(d, scene, pattern.points.size(), transfer));
  RayQueues<T> queues(scene);
  BlockSpread<T> spread;
  const TileErrors told = pattern.has_half_buffers() ? errors : TileErrors{};
  for (int y = tile.y_begin; y < tile.y_end; y += tile.block_step)
    for (int x = tile.x_begin; x < tile.x_end; x += tile.block_step)
      render_block(scene, pattern, transfer,
                   {x, y, std::min(block_side, tile.x_end - x),
                    std::min(block_side, tile.y_end - y), tile.subtiles},
                   background, canvas, told, queues, ledger, spread, traced.beyond);
  return traced;
}

/// Traces a tile's samples and writes down what they ask of soft lights.
template <typename T>
void record_blocks(const PacketScene<T>& scene, const SamplePattern& pattern, const Tile& tile,
                   LightLedger<T>& ledger) {
  using D = hn::ScalableTag<T>;
  const D d;
  ledger.begin(PacketShape<D>::lanes);
  RayQueues<T> queues(scene);
  SampleColours<T> colours;
  for (int y = tile.y_begin; y < tile.y_end; y += tile.block_step)
    for (int x = tile.x_begin; x < tile.x_end; x += tile.block_step) {
      BlockCandidates<T> candidates(scene, x / block_side, y / block_side);
      const Block block{x, y, std::min(block_side, tile.x_end - x),
                        std::min(block_side, tile.y_end - y), tile.subtiles & candidates.subtiles};
      if (block.subtiles == 0) continue;
      const BlockRays<D> rays(d, scene, block, pattern.jitter);
      for (std::size_t sample = 0; sample < pattern.points.size(); ++sample)
        trace_packets(
            d, rays.eye,
            SamplePackets<D>(rays, candidates, block, pattern.points[sample],
                             {sample % static_cast<std::size_t>(scene.light_sets), &ledger}),
            false, queues, colours, static_cast<T*>(nullptr));
    }
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
