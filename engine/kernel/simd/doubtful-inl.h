// Samples that a scene's precision does not carry: those whose paths magnify what it rounds off are
// traced again in double, from the eye on.

#include "engine/kernel/sample_point.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Where samples are, and which of their block's they are.
struct DoubtfulSamples {
  std::size_t count = 0;
  alignas(64) double x[block_pixels];  ///< from the image's lower left corner, in pixels
  alignas(64) double y[block_pixels];
  std::size_t index[block_pixels];
};

/// Those that use the light sets' `quarter`.
template <class D, class Rays, typename T = hn::TFromD<D>>
HWY_INLINE void find_doubtful(D d, const Rays& rays, const LightSets<T>& light_sets, int quarter,
                              const SampleColours<T>& colours, DoubtfulSamples& samples) {
  samples.count = 0;
  const auto most = hn::Set(d, static_cast<T>(most_colour_error));
  for (std::size_t begin = 0; begin < block_pixels; begin += hn::Lanes(d)) {
    // What is no number is doubtful as well.
    const auto doubtful = hn::Not(hn::Le(hn::Load(d, colours.doubt + begin), most));
    for (std::uint64_t bits = bits_of(d, doubtful); bits != 0; bits &= bits - 1) {
      const std::size_t at = begin + hwy::Num0BitsBelowLS1Bit_Nonzero64(bits);
      const auto ray = static_cast<int>(at);
      if (light_sets.differ && PixelPlace<D>(ray).quarter() != quarter) continue;
      const SamplePoint point = rays.image_point(ray);
      samples.x[samples.count] = point.x;
      samples.y[samples.count] = point.y;
      samples.index[samples.count++] = at;
    }
  }
}

/// Sets the samples' colours, one after another, and of `cover`, if there is one, what stands at
/// their indices: to 1 where one has met something, else to 0. What is to be traced in double is
/// compiled with the kernels that are, once.
void trace_in_double(const PacketScene<double>& scene, const DoubtfulSamples& samples,
                     const LightSets<double>& light_sets, SampleColours<double>& colours,
                     float* cover);

/// Traces a block's doubtful samples again and replaces their colours.
template <class D, class Rays>
HWY_NOINLINE void trace_doubtful_again(D d, const PacketScene<double>& scene, const Rays& rays,
                                       const LightSets<float>& light_sets,
                                       SampleColours<float>& colours, float* cover) {
  DoubtfulSamples samples;
  SampleColours<double> exact;
  for (int quarter = 0; quarter < (light_sets.differ ? 4 : 1); ++quarter) {
    find_doubtful(d, rays, light_sets, quarter, colours, samples);
    if (samples.count == 0) continue;
    LightSets<double> of_quarter({light_sets.of_quarters[quarter].index, nullptr});
    of_quarter.followed.index = light_sets.followed.index;
    trace_in_double(scene, samples, of_quarter, exact, cover);
    for (std::size_t i = 0; i < samples.count; ++i) {
      const std::size_t at = samples.index[i];
      colours.red[at] = static_cast<float>(exact.red[i]);
      colours.green[at] = static_cast<float>(exact.green[i]);
      colours.blue[at] = static_cast<float>(exact.blue[i]);
    }
  }
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
