// Single pixels of blocks under soft lights, traced side by side.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>

#include "engine/image/sampled_pixel.h"
#include "engine/memory/aligned_array.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// What pixels' samples come to, packet by packet.
template <typename T>
struct PixelResults {
  BlockColours<T> shown;
  alignas(64) T cover[block_pixels] = {};
  alignas(64) T error2[block_pixels];
  alignas(64) T variance[block_pixels];

  template <class D, class V = hn::Vec<D>>
  HWY_INLINE void set(D d, std::size_t at, const V3<V>& colour, const Spread<V>& spread) {
    store(d, colour, at, shown);
    hn::Store(spread.error2, d, error2 + at);
    hn::Store(spread.variance, d, variance + at);
  }
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE void set(D d, std::size_t at, const CoveredColour<V>& colour,
                      const Spread<V>& spread) {
    set(d, at, colour.colour, spread);
    hn::Store(colour.cover, d, cover + at);
  }

  SampledPixel pixel(std::size_t at, bool is_number) const {
    return {{static_cast<float>(shown.red[at]), static_cast<float>(shown.green[at]),
             static_cast<float>(shown.blue[at]), static_cast<float>(cover[at])},
            {static_cast<float>(error2[at]), static_cast<float>(variance[at])},
            is_number};
  }
};

/// Some pixels of a block, which are traced together, sample by sample.
template <typename T>
class PickedPixels {
  using D = hn::ScalableTag<T>;
  using Shape = PacketShape<D>;

 public:
  PickedPixels(const PickedPixels&) = delete;
  PickedPixels& operator=(const PickedPixels&) = delete;
  /// `number` among those that are queued together.
  PickedPixels(const PacketScene<T>& scene, const SamplePattern& pattern, const BlockPixels& pixels,
               std::size_t number)
      : block_{pixels.x_begin,
               pixels.y_begin,
               std::min(block_side, scene.view.width - pixels.x_begin),
               std::min(block_side, scene.view.height - pixels.y_begin),
               0,
               &picked_},
        first_pixel_(number * block_pixels),
        candidates_(scene, pixels.x_begin / block_side, pixels.y_begin / block_side),
        rays_(D(), scene, pick(pixels.places), pattern.jitter),
        sums_(pattern, pixels.channels == 4, true) {}

  SamplePackets<D> packets(const SamplePoint& sample, const LightSet<T>& light_set) {
    return {rays_, candidates_, block_, sample, light_set, first_pixel_};
  }
  void intersect(const SamplePoint& sample, const LightSet<T>& light_set, Hits<T>& hits) {
    intersect_from_eye(D(), rays_.eye, packets(sample, light_set), hits, cover_of_sample());
  }
  /// Which rays of the sample have met something, if that is wanted.
  T* cover_of_sample() { return sums_.cover_of_sample(); }
  void add(std::size_t sample, const SampleColours<T>& colours) {
    sums_.add(D(), sample, block_, rays_, colours);
  }

  /// After the last sample: one result for each place.
  void finish(std::span<const std::uint8_t> places, Transfer transfer,
              SampledPixel* results) const {
    const D d;
    PixelResults<T> sampled;
    for (int packet = 0; packet < Shape::packets; ++packet) {
      if (!PacketPlace<D>(packet).is_in(block_)) continue;
      const std::size_t at = static_cast<std::size_t>(packet) * Shape::lanes;
      const Spread<hn::Vec<D>> spread = sums_.spread(d, at, Transfer::linear);
      if (sums_.has_cover())
        sampled.set(d, at, sums_.covered_mean(d, at, transfer), spread);
      else
        sampled.set(d, at, sums_.mean(d, at, transfer), spread);
    }
    for (const std::uint8_t place : places) {
      const std::size_t at = Shape::index_of(place % block_side, place / block_side);
      *results++ = sampled.pixel(at, sums_.beyond().is_number(at));
    }
  }

 private:
  const Block& pick(std::span<const std::uint8_t> places) {
    for (const std::uint8_t place : places) {
      const int x = place % block_side;
      const int y = place / block_side;
      std::uint16_t& row = picked_[static_cast<std::size_t>(y)];
      row = static_cast<std::uint16_t>(row | 1U << x);
      block_.subtiles |= 1U << subtile_index(x, y);
    }
    return block_;
  }

  PixelBits picked_{};
  Block block_;
  std::size_t first_pixel_;
  BlockCandidates<T> candidates_;
  BlockRays<D> rays_;
  BlockSums<D> sums_;
};

/// Pixels of blocks side by side: those that use the same places on soft lights, as a pixel's
/// samples do not. At most blocks_at_once.
template <typename T>
void sample_side_by_side(const PacketScene<T>& scene, const SamplePattern& pattern,
                         Transfer transfer, std::span<const BlockPixels> blocks,
                         SampledPixel* results) {
  const hn::ScalableTag<T> d;
  const std::size_t count = blocks.size();
  const auto picked = make_aligned_array<PickedPixels<T>>(count);
  for (std::size_t i = 0; i < count; ++i)
    new (&picked[i]) PickedPixels<T>(scene, pattern, blocks[i], i);
  const auto hits = make_aligned_array<Hits<T>>(count);
  const auto colours = make_aligned_array<SampleColours<T>>(count);
  RayQueues<T> queues(scene);
  const EyeRays<hn::ScalableTag<T>> eye(d, scene);
  for (std::size_t nth = 0; nth < pattern.points.size(); ++nth) {
    const SamplePoint& sample = pattern.points[nth];
    const LightSet<T> light_set = light_set_of_sample<T>(scene, pattern, nth, nullptr);
    for (std::size_t i = 0; i < count; ++i) picked[i].intersect(sample, light_set, hits[i]);
    shade_blocks(d, eye, hits.get(), count, picked[0].packets(sample, light_set).light_sets(),
                 queues, colours.get());
    trace_queued(scene, queues, colours.get());
    trace_doubtful(
        d, scene, count,
        [&](std::size_t i) HWY_ATTR { return picked[i].packets(sample, light_set); },
        [&](std::size_t i) { return picked[i].cover_of_sample(); }, colours.get());
    for (std::size_t i = 0; i < count; ++i) picked[i].add(nth, colours[i]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    picked[i].finish(blocks[i].places, transfer, results);
    results += blocks[i].places.size();
  }
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
