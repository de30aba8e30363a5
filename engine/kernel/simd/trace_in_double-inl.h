// Samples that other kernels' precision does not carry: see doubtful-inl.h.

#include <algorithm>
#include <cstddef>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

void trace_in_double(const PacketScene<double>& scene, DoubtfulSamples& samples,
                     const LightSets<double>& light_sets, SampleColours<double>* colours) {
  using D = hn::ScalableTag<double>;
  const D d;
  using V = hn::Vec<D>;
  const std::size_t lanes = hn::Lanes(d);
  const EyeRays<D> eye(d, scene);
  const RayOrigin<V> origin = eye.origin(d);
  const V far_away = hn::Set(d, std::numeric_limits<double>::max());
  static_assert(DoubtfulSamples::most <= rays_in_batch);
  RayQueues<double> queues(scene);
  for (std::size_t begin = 0; begin < samples.count; begin += block_pixels) {
    const std::size_t count = std::min<std::size_t>(samples.count - begin, block_pixels);
    Hits<double> hits;
    for (std::size_t i = 0; i < count; i += lanes) {
      const std::size_t at = begin + i;
      const auto active = hn::FirstN(d, count - i);
      const V3<V> direction =
          eye.direction(d, {0, 0, hn::IfThenElseZero(active, hn::Load(d, samples.x + at)),
                            hn::Neg(hn::IfThenElseZero(active, hn::Load(d, samples.y + at)))});
      const Hit<V> hit = find_followed(d, scene, origin, direction, far_away, active);
      store(d, direction, hit, hn::Iota(d, static_cast<double>(at)), active, scene.has_own_normals,
            i, hits);
    }
    for (std::size_t i = 0; i < count; ++i) samples.has_met[begin + i] = !(hits.id[i] < 0);
    shade_hits(d, eye, hits, (count + lanes - 1) / lanes, light_sets, false, queues,
               colours[begin / block_pixels]);
  }
  trace_queued(scene, queues, colours);
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
