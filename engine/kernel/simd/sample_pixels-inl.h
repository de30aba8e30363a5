// Single pixels of a block: the samples of each are traced side by side, or under soft lights the
// pixels.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

#include "engine/kernel/simd/sample_pixels.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Places of samples, as many as a block has colours.
template <typename T>
struct SampleLanes {
  std::size_t count = 0;
  alignas(64) T right[block_pixels] = {};
  alignas(64) T up[block_pixels] = {};
  alignas(64) T is_in_half_a[block_pixels] = {};  ///< 1 in half buffer A, 0 in B

  HWY_INLINE SampleLanes(const SamplePattern& pattern, std::size_t begin)
      : count(std::min<std::size_t>(block_pixels, pattern.points.size() - begin)) {
    for (std::size_t i = 0; i < count; ++i) {
      right[i] = static_cast<T>(pattern.points[begin + i].x);
      up[i] = static_cast<T>(pattern.points[begin + i].y);
      is_in_half_a[i] = T(begin + i < pattern.half_a_count ? 1 : 0);
    }
  }
};

/// A pixel's place in its block, from the upper left.
struct BlockPlace {
  int x;
  int y;
};

/// Packets of a pixel's samples, and the candidates, as SubtileCandidates, of what they go through.
template <class D, class Candidates, typename T = hn::TFromD<D>>
class PixelPackets {
 public:
  /// Of the pixel whose lower left corner is (x, y), y = 0 at the bottom; `place` is its place in
  /// its block, from the top.
  HWY_INLINE PixelPackets(const EyeRays<D>& eye, const SampleLanes<T>& samples, double x, double y,
                          const BlockPlace& place, double jitter, Candidates& candidates)
      : eye_(eye),
        samples_(samples),
        x_(x),
        y_(y),
        place_(place),
        jitter_(jitter),
        candidates_(candidates) {}

  HWY_INLINE int count() const { return static_cast<int>((samples_.count + lanes - 1) / lanes); }
  static constexpr bool is_in(int /*i*/) { return true; }
  static constexpr std::size_t first_pixel() { return 0; }
  HWY_INLINE LightSets<T> light_sets() const { return LightSets<T>({}); }  // there is no soft light
  HWY_INLINE Candidates& candidates(int /*i*/) const { return candidates_; }
  /// Where sample_in() has them.
  HWY_INLINE ImagePoints<hn::Vec<D>> image_points(D d, int i) const {
    using V = hn::Vec<D>;
    V right = hn::Load(d, samples_.right + first(i));
    V up = hn::Load(d, samples_.up + first(i));
    if (!(jitter_ > 0)) return {x_, y_, right, hn::Neg(up)};
    const PatternTurn turn(place_.x, place_.y);
    if (turn.is_transposed) std::swap(right, up);
    if (turn.is_mirrored) right = hn::Sub(hn::Set(d, T(1)), right);
    const SamplePoint moved = jitter_of(place_.x, place_.y);
    const auto by = [&](double part)
                        HWY_ATTR { return hn::Set(d, static_cast<T>(jitter_ * part)); };
    return {x_, y_, moved_away(d, right, by(moved.x)), hn::Neg(moved_away(d, up, by(moved.y)))};
  }
  HWY_INLINE hn::Mask<D> active(D d, int i) const {
    return hn::FirstN(d, samples_.count - first(i));
  }
  HWY_INLINE SamplePoint image_point(int ray) const {
    const SamplePoint at =
        sample_in(place_.x, place_.y, {samples_.right[ray], samples_.up[ray]}, jitter_);
    return {x_ + at.x, y_ + at.y};
  }

 private:
  static constexpr std::size_t lanes = PacketShape<D>::lanes;
  static constexpr std::size_t first(int i) { return lanes * static_cast<std::size_t>(i); }

  const EyeRays<D>& eye_;
  const SampleLanes<T>& samples_;
  double x_;
  double y_;
  BlockPlace place_;
  double jitter_;
  Candidates& candidates_;
};

/// Sums over each pixel's samples, the pixels side by side.
template <typename T>
struct PixelSums {
  BlockColours<T> all = {};
  BlockColours<T> half_a = {};
  BlockColours<T> origin = {};               ///< a sample
  alignas(64) T squares[block_pixels] = {};  ///< of the others' differences from it
  alignas(64) T cover[block_pixels] = {};    ///< hits, if they are wanted
  alignas(64) T half_a_cover[block_pixels] = {};
  bool is_number[block_pixels];
};

template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void add_lanes(D d, const V3<hn::Vec<D>>& colour, std::size_t pixel,
                          BlockColours<T>& sums) {
  sums.red[pixel] += hn::GetLane(hn::SumOfLanes(d, colour.x));
  sums.green[pixel] += hn::GetLane(hn::SumOfLanes(d, colour.y));
  sums.blue[pixel] += hn::GetLane(hn::SumOfLanes(d, colour.z));
}

/// Adds the hits among a pixel's samples.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void add_cover(D d, const T* hits, const SampleLanes<T>& samples, std::size_t pixel,
                          PixelSums<T>& sums) {
  using V = hn::Vec<D>;
  V all = hn::Zero(d);
  V half_a = all;
  for (std::size_t i = 0; i < samples.count; i += hn::Lanes(d)) {
    const V hit = hn::IfThenElseZero(hn::FirstN(d, samples.count - i), hn::Load(d, hits + i));
    all = hn::Add(all, hit);
    half_a = hn::MulAdd(hit, hn::Load(d, samples.is_in_half_a + i), half_a);
  }
  sums.cover[pixel] += hn::GetLane(hn::SumOfLanes(d, all));
  sums.half_a_cover[pixel] += hn::GetLane(hn::SumOfLanes(d, half_a));
}

/// Traces a pixel's samples, those with which it begins or more of them, and adds them to its sums.
template <class D, class Packets, typename T = hn::TFromD<D>>
HWY_INLINE void sample_pixel(D d, const EyeRays<D>& eye, const Packets& packets,
                             const SampleLanes<T>& samples, bool is_begin, bool has_cover,
                             std::size_t pixel, RayQueues<T>& queues, PixelSums<T>& sums) {
  using V = hn::Vec<D>;
  const std::size_t lanes = hn::Lanes(d);
  SampleColours<T> colours;
  alignas(64) T hits[block_pixels];
  trace_packets(d, eye, packets, false, queues, colours, has_cover ? hits : nullptr);
  if (has_cover) add_cover(d, hits, samples, pixel, sums);

  if (is_begin) {
    const V3<V> seen = clamped(d, load(d, colours, 0));
    sums.origin.red[pixel] = hn::GetLane(seen.x);
    sums.origin.green[pixel] = hn::GetLane(seen.y);
    sums.origin.blue[pixel] = hn::GetLane(seen.z);
  }
  const V3<V> origin{hn::Set(d, sums.origin.red[pixel]), hn::Set(d, sums.origin.green[pixel]),
                     hn::Set(d, sums.origin.blue[pixel])};
  const V zero = hn::Zero(d);
  V3<V> all{zero, zero, zero};
  V3<V> half_a = all;
  V squares = zero;
  V numbers = zero;  // one that is none makes all none
  for (std::size_t i = 0; i < samples.count; i += lanes) {
    const auto active = hn::FirstN(d, samples.count - i);
    const V3<V> colour = load(d, colours, i);
    numbers = hn::Add(numbers,
                      hn::IfThenElseZero(active, hn::Add(hn::Add(colour.x, colour.y), colour.z)));
    const V3<V> seen = select(active, clamped(d, colour), V3<V>{zero, zero, zero});
    all = add(all, seen);
    half_a = mul_add(seen, hn::Load(d, samples.is_in_half_a + i), half_a);
    const V3<V> difference = sub(seen, origin);
    squares = hn::Add(squares, hn::IfThenElseZero(active, dot(difference, difference)));
  }
  add_lanes(d, all, pixel, sums.all);
  add_lanes(d, half_a, pixel, sums.half_a);
  sums.squares[pixel] += hn::GetLane(hn::SumOfLanes(d, squares));
  sums.is_number[pixel] &= hn::AllFalse(d, hn::IsNaN(numbers));
}

/// Samples of a pixel side by side: they meet the same things.
template <typename T>
void sample_each(const PacketScene<T>& scene, const SamplePattern& pattern, Transfer transfer,
                 const BlockPixels& pixels, SampledPixel* results) {
  using D = hn::ScalableTag<T>;
  const D d;
  using V = hn::Vec<D>;
  constexpr std::size_t lanes = PacketShape<D>::lanes;
  BlockCandidates<T> candidates(scene, pixels.x_begin / block_side, pixels.y_begin / block_side);
  const EyeRays<D> eye(d, scene);
  // To look at each primitive once more pays off where there are many, and several packets that
  // then need not.
  constexpr std::size_t worth_packets = 3;
  bool narrows = false;
  if (pattern.points.size() >= worth_packets * lanes)
    for_each_kind([&]<class Kind>(std::type_identity<Kind>) HWY_ATTR {
      if (HasConeTest<Kind> &&
          candidates.entries[kind_index<Kind>].entries.size() > entries_at_once)
        narrows = true;
    });
  NarrowedEntries found;
  const bool has_cover = pixels.channels == 4;
  RayQueues<T> queues(scene);
  PixelSums<T> sums;
  std::fill_n(sums.is_number, block_pixels, true);
  for (std::size_t begin = 0; begin < pattern.points.size(); begin += block_pixels) {
    const SampleLanes<T> samples(pattern, begin);
    for (std::size_t i = 0; i < pixels.places.size(); ++i) {
      const int x = pixels.places[i] % block_side;
      const int y = pixels.places[i] / block_side;
      const int x_left = pixels.x_begin + x;
      const int y_low = scene.view.height - 1 - pixels.y_begin - y;
      SubtileCandidates<T> subtile{candidates, subtile_index(x, y)};
      const auto sample = [&](auto& own) HWY_ATTR {
        const PixelPackets<D, std::decay_t<decltype(own)>> packets(eye, samples, x_left, y_low,
                                                                   {x, y}, pattern.jitter, own);
        sample_pixel(d, eye, packets, samples, begin == 0, has_cover, i, queues, sums);
      };
      if (narrows) {
        PixelCandidates<T> narrowed(subtile, cone_around(d, eye, x_left, y_low), found);
        sample(narrowed);
      } else {
        sample(subtile);
      }
    }
  }
  const std::size_t count = pattern.points.size();
  const V share = share_of(d, count);
  PixelResults<T> sampled;
  for (std::size_t first = 0; first < pixels.places.size(); first += lanes) {
    const V3<V> all = load(d, sums.all, first);
    const V3<V> half_a = load(d, sums.half_a, first);
    const V3<V> origin = load(d, sums.origin, first);
    const V squares = hn::Load(d, sums.squares + first);
    if (has_cover) {
      const CoveredColour<V> covered{all, hn::Load(d, sums.cover + first)};
      const CoveredColour<V> half{half_a, hn::Load(d, sums.half_a_cover + first)};
      sampled.set(d, first, resolved(d, covered, share, transfer),
                  spread_of(d, half, covered, origin, squares, count, Transfer::linear));
    } else {
      sampled.set(d, first, resolved(d, all, share, transfer),
                  spread_of(d, half_a, all, origin, squares, count, Transfer::linear));
    }
  }
  for (std::size_t i = 0; i < pixels.places.size(); ++i)
    results[i] = sampled.pixel(i, sums.is_number[i]);
}

template <typename T>
void sample_blocks(const PacketScene<T>& scene, const SamplePattern& pattern, Transfer transfer,
                   std::span<const BlockPixels> blocks, SampledPixel* results) {
  const bool is_together = !scene.soft_lights.empty();
  for (std::size_t begin = 0; begin < blocks.size();) {
    const std::size_t count =
        is_together ? std::min(blocks_at_once, blocks.size() - begin) : std::size_t{1};
    const auto some = blocks.subspan(begin, count);
    if (is_together)
      sample_side_by_side(scene, pattern, transfer, some, results);
    else
      sample_each(scene, pattern, transfer, some.front(), results);
    for (const BlockPixels& block : some) results += block.places.size();
    begin += count;
  }
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
