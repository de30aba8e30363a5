// Samples that a scene's precision does not carry, of what is too near to the eye or too far from a
// light: they are traced again in double, from the eye on.

#include "engine/kernel/sample_point.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Where samples are, and which of their blocks' they are.
struct DoubtfulSamples {
  /// The blocks that are traced together seldom have more.
  static constexpr std::size_t most = std::size_t{2} * block_pixels;

  std::size_t count = 0;
  alignas(64) double x[most];  ///< from the image's lower left corner, in pixels
  alignas(64) double y[most];
  std::size_t index[most];  ///< counted through the blocks
  bool has_met[most];       ///< something, when it was traced
};

/// Adds a block's that use the light sets' `quarter`; calls full() when there is no room for more.
template <class D, class Rays, class Full, typename T = hn::TFromD<D>>
HWY_INLINE void find_doubtful(D d, const Rays& rays, bool by_quarters, int quarter,
                              const SampleColours<T>& colours, std::size_t block,
                              DoubtfulSamples& samples, const Full& full) {
  const auto most = hn::Set(d, static_cast<T>(most_colour_error));
  for (std::size_t begin = 0; begin < block_pixels; begin += hn::Lanes(d)) {
    const auto doubtful = hn::Gt(hn::Load(d, colours.doubt + begin), most);
    for (std::uint64_t bits = bits_of(d, doubtful); bits != 0; bits &= bits - 1) {
      const std::size_t at = begin + hwy::Num0BitsBelowLS1Bit_Nonzero64(bits);
      const auto ray = static_cast<int>(at);
      if (by_quarters && PixelPlace<D>(ray).quarter() != quarter) continue;
      const SamplePoint point = rays.image_point(ray);
      samples.x[samples.count] = point.x;
      samples.y[samples.count] = point.y;
      samples.index[samples.count++] = block * block_pixels + at;
      if (samples.count == DoubtfulSamples::most) full();
    }
  }
}

/// Sets the samples' colours, in as many blocks as are needed, one after another, and whether they
/// have met something. What is to be traced in double is compiled with the kernels that are, once.
void trace_in_double(const PacketScene<double>& scene, DoubtfulSamples& samples,
                     const LightSets<double>& light_sets, SampleColours<double>* colours);

/// Traces the doubtful samples of blocks again and replaces their colours. rays_of(block) are a
/// block's packets; cover_of(block), if it is not null, gets 1 where they meet something, else 0.
template <class D, class RaysOf, class CoverOf>
HWY_NOINLINE void trace_doubtful_again(D d, const PacketScene<double>& scene,
                                       std::size_t block_count, const RaysOf& rays_of,
                                       const CoverOf& cover_of, SampleColours<float>* colours) {
  const LightSets<float> light_sets = rays_of(0).light_sets();
  DoubtfulSamples samples;
  SampleColours<double> exact[DoubtfulSamples::most / block_pixels];
  for (int quarter = 0; quarter < (light_sets.by_quarters ? 4 : 1); ++quarter) {
    // Of rays in no order all that they use together.
    const auto at = static_cast<std::size_t>(quarter);
    const std::size_t set =
        light_sets.by_quarters ? light_sets.of_quarters[at].index : light_sets.followed.index;
    LightSets<double> of_quarter({set, nullptr});
    of_quarter.followed = {light_sets.followed.index, nullptr};
    const auto trace_again = [&]() HWY_ATTR {
      trace_in_double(scene, samples, of_quarter, exact);
      for (std::size_t i = 0; i < samples.count; ++i) {
        const SampleColours<double>& from = exact[i / block_pixels];
        const std::size_t block = samples.index[i] / block_pixels;
        const std::size_t at = samples.index[i] % block_pixels;
        colours[block].red[at] = static_cast<float>(from.red[i % block_pixels]);
        colours[block].green[at] = static_cast<float>(from.green[i % block_pixels]);
        colours[block].blue[at] = static_cast<float>(from.blue[i % block_pixels]);
        if (float* const cover = cover_of(block)) cover[at] = samples.has_met[i] ? 1.0F : 0.0F;
      }
      samples.count = 0;
    };
    for (std::size_t block = 0; block < block_count; ++block)
      find_doubtful(d, rays_of(block), light_sets.by_quarters, quarter, colours[block], block,
                    samples, trace_again);
    if (samples.count > 0) trace_again();
  }
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
