// Samples that other kernels' precision does not carry: see doubtful-inl.h.

#include <algorithm>
#include <cstddef>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// As trace_in_double(); the rays that follow are kept in a `Followed`.
template <class Followed>
HWY_INLINE void trace_samples(const PacketScene<double>& scene, const DoubtfulSamples& samples,
                              std::size_t light_set, std::size_t followed_light_set,
                              SampleColours<double>& colours, float* cover) {
  const hn::ScalableTag<double> d;
  using V = hn::Vec<decltype(d)>;
  const EyeRays<decltype(d)> eye(d, scene);
  const V zero = hn::Zero(d);
  const RayOrigin<V> origin = eye.origin(d);
  const V far_away = hn::Set(d, std::numeric_limits<double>::max());
  Followed followed(scene.max_depth > 0);
  followed.light_set.index = followed_light_set;
  alignas(64) double channels[4][hn::MaxLanes(d)];
  for (std::size_t i = 0; i < samples.count; i += hn::Lanes(d)) {
    const auto active = hn::FirstN(d, samples.count - i);
    const V pixel = hn::IfThenElseZero(active, hn::Load(d, samples.index + i));
    const V3<V> direction =
        eye.direction(d, 0, 0, hn::IfThenElseZero(active, hn::Load(d, samples.x + i)),
                      hn::Neg(hn::IfThenElseZero(active, hn::Load(d, samples.y + i))));
    const Hit<V> hit = find_followed(d, scene, origin, direction, far_away, active);
    const V3<V> colour =
        eye.shade(d, direction, hit, active, pixel, {light_set, nullptr}, followed);
    hn::Store(colour.x, d, channels[0]);
    hn::Store(colour.y, d, channels[1]);
    hn::Store(colour.z, d, channels[2]);
    hn::Store(hn::IfThenElseZero(hn::Ge(hit.id, zero), hn::Set(d, 1.0)), d, channels[3]);
    for (std::size_t lane = 0; lane < std::min(samples.count - i, hn::Lanes(d)); ++lane) {
      const auto at = static_cast<std::size_t>(samples.index[i + lane]);
      colours.red[at] = channels[0][lane];
      colours.green[at] = channels[1][lane];
      colours.blue[at] = channels[2][lane];
      if (cover != nullptr) cover[at] = static_cast<float>(channels[3][lane]);
    }
  }
  if (scene.max_depth > 0) trace_followed(scene, followed, colours);
}

void trace_in_double(const PacketScene<double>& scene, const DoubtfulSamples& samples,
                     std::size_t light_set, std::size_t followed_light_set,
                     SampleColours<double>& colours, float* cover) {
  if (scene.transmits)
    trace_samples<FollowedRays<double, true>>(scene, samples, light_set, followed_light_set,
                                              colours, cover);
  else
    trace_samples<FollowedRays<double, false>>(scene, samples, light_set, followed_light_set,
                                               colours, cover);
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
