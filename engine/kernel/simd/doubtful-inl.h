// Samples that a scene's precision does not carry: those whose paths magnify what it rounds off are
// traced again in double, from the eye on.

#include <algorithm>

#include "engine/kernel/sample_point.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Where samples are, and which of their block's they are.
struct DoubtfulSamples {
  std::size_t count = 0;
  alignas(64) double x[block_pixels];  ///< from the image's lower left corner, in pixels
  alignas(64) double y[block_pixels];
  alignas(64) double index[block_pixels];
};

/// Those whose pixels have a place, as `rays` count them, in the pattern of light sets.
template <class D, class Rays, typename T = hn::TFromD<D>>
HWY_INLINE void find_doubtful(D d, const Rays& rays, int place, const SampleColours<T>& colours,
                              DoubtfulSamples& samples) {
  samples.count = 0;
  const auto most = hn::Set(d, static_cast<T>(most_colour_error));
  for (std::size_t begin = 0; begin < block_pixels; begin += hn::Lanes(d)) {
    // What is no number is doubtful as well.
    const auto doubtful = hn::Not(hn::Le(hn::Load(d, colours.doubt + begin), most));
    for (std::uint64_t bits = bits_of(d, doubtful); bits != 0; bits &= bits - 1) {
      const std::size_t at = begin + hwy::Num0BitsBelowLS1Bit_Nonzero64(bits);
      if (rays.place_of(static_cast<int>(at)) != place) continue;
      const SamplePoint point = rays.image_point(static_cast<int>(at));
      samples.x[samples.count] = point.x;
      samples.y[samples.count] = point.y;
      samples.index[samples.count++] = static_cast<double>(at);
    }
  }
}

/// The samples' colours, each in its place; `cover`, if there is one, gets 1 where one has met
/// something, else 0. What is to be traced in double is compiled with the kernels that are, once.
void trace_in_double(const PacketScene<double>& scene, const DoubtfulSamples& samples,
                     std::size_t light_set, std::size_t followed_light_set,
                     SampleColours<double>& colours, float* cover);

/// Traces a block's doubtful samples again and replaces their colours.
template <class D, class Rays>
HWY_NOINLINE void trace_doubtful_again(D d, const PacketScene<double>& scene, const Rays& rays,
                                       SampleColours<float>& colours, float* cover) {
  DoubtfulSamples samples;
  SampleColours<double> exact;
  for (int place = 0; place < rays.place_count(); ++place) {
    find_doubtful(d, rays, place, colours, samples);
    if (samples.count == 0) continue;
    const std::size_t own = rays.light_set_at(place).index;
    trace_in_double(scene, samples, own, rays.light_set().index, exact, cover);
    for (std::size_t i = 0; i < samples.count; ++i) {
      const auto at = static_cast<std::size_t>(samples.index[i]);
      colours.red[at] = static_cast<float>(exact.red[at]);
      colours.green[at] = static_cast<float>(exact.green[at]);
      colours.blue[at] = static_cast<float>(exact.blue[at]);
    }
  }
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
