// The rays from the eye through a block's pixels.

#include <cstddef>
#include <cstdint>

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

  /// Of `sample` in the packet's pixels.
  HWY_INLINE ImagePoints<V> image_points(D d, const PacketPlace<D>& place,
                                         const SamplePoint& sample) const {
    const double left = block_.x_begin + place.x;
    const double low = height_ - 1 - block_.y_begin - place.y;
    if (!(jitter_ > 0)) return {left + sample.x, low + sample.y, offsets_.x, offsets_.y};
    const LaneSamples<D> in_lanes(d, place, sample, jitter_);
    return {left, low, hn::Add(offsets_.x, in_lanes.x), hn::Sub(offsets_.y, in_lanes.y)};
  }

  /// As image_points(), of one pixel: from the image's lower left corner, in pixels.
  HWY_INLINE SamplePoint image_point(const PixelPlace<D>& pixel, const SamplePoint& sample) const {
    const SamplePoint at = sample_in(pixel.x, pixel.y, sample, jitter_);
    return {block_.x_begin + pixel.x + at.x, height_ - 1 - block_.y_begin - pixel.y + at.y};
  }

  /// The lanes whose pixels are in the block, and wanted.
  HWY_INLINE hn::Mask<D> active(D d, const PacketPlace<D>& place) const {
    const auto is_in =
        hn::And(hn::Lt(offsets_.x, hn::Set(d, static_cast<T>(block_.width - place.x))),
                hn::Lt(offsets_.y, hn::Set(d, static_cast<T>(block_.height - place.y))));
    if (HWY_LIKELY(block_.pixels == nullptr)) return is_in;
    using Shape = PacketShape<D>;
    std::uint32_t wanted = 0;
    for (int row = 0; row < Shape::height; ++row) {
      const int y = place.y + row;
      const std::uint32_t pixels = (*block_.pixels)[static_cast<std::size_t>(y)];
      wanted |= (pixels >> place.x & ((1U << Shape::width) - 1)) << (row * Shape::width);
    }
    alignas(8) std::uint8_t bytes[8] = {static_cast<std::uint8_t>(wanted),
                                        static_cast<std::uint8_t>(wanted >> 8U)};
    return hn::And(is_in, hn::LoadMaskBits(d, bytes));
  }

  const EyeRays<D> eye;

 private:
  Block block_;
  LaneOffsets<D> offsets_;
  double jitter_;
  int height_;
};

/// The set of places on soft lights that a pixel's nth sample uses, but for its place in a square
/// of 2 x 2.
template <typename T>
HWY_INLINE LightSet<T> light_set_of_sample(const PacketScene<T>& scene,
                                           const SamplePattern& pattern, std::size_t nth,
                                           LightLedger<T>* ledger) {
  const int set = raytracer::light_set_of_sample(nth, pattern.half_a_count, scene.light_sets);
  return {static_cast<std::size_t>(set), ledger};
}

/// A block's packets at one sample's place.
template <class D, typename T = hn::TFromD<D>>
class SamplePackets {
 public:
  HWY_INLINE SamplePackets(const BlockRays<D>& rays, BlockCandidates<T>& candidates,
                           const Block& block, const SamplePoint& sample,
                           const LightSet<T>& light_set, std::size_t first_pixel)
      : rays_(rays),
        candidates_(candidates),
        block_(block),
        sample_(sample),
        light_set_(light_set),
        first_pixel_(first_pixel) {}

  static constexpr int count() { return PacketShape<D>::packets; }
  HWY_INLINE std::size_t first_pixel() const { return first_pixel_; }
  /// Pixels differ from each other by their place in a square of 2 x 2, if there are several sets.
  HWY_INLINE LightSets<T> light_sets() const {
    LightSets<T> sets(light_set_);
    const PacketScene<T>& scene = rays_.eye.scene();
    sets.by_quarters = scene.light_sets > 1;
    if (!sets.by_quarters) return sets;
    const int of_sample = static_cast<int>(light_set_.index);
    for (int i = 0; i < 4; ++i) {
      const int set = light_set_of(i % 2, i / 2, of_sample, scene.light_sets);
      sets.of_quarters[i].index = static_cast<std::size_t>(set);
    }
    return sets;
  }
  HWY_INLINE bool is_in(int i) const { return PacketPlace<D>(i).is_in(block_); }
  HWY_INLINE SubtileCandidates<T> candidates(int i) const {
    return {candidates_, PacketPlace<D>(i).subtile()};
  }
  HWY_INLINE ImagePoints<hn::Vec<D>> image_points(D d, int i) const {
    return rays_.image_points(d, PacketPlace<D>(i), sample_);
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
  std::size_t first_pixel_;
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
