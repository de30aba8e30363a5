// Samples that other kernels' precision does not carry: see doubtful-inl.h.

#include <cstddef>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

void trace_in_double(const PacketScene<double>& scene, const DoubtfulSamples& samples,
                     const LightSets<double>& light_sets, SampleColours<double>& colours,
                     float* cover) {
  using D = hn::ScalableTag<double>;
  const D d;
  using V = hn::Vec<D>;
  const std::size_t lanes = hn::Lanes(d);
  const EyeRays<D> eye(d, scene);
  const RayOrigin<V> origin = eye.origin(d);
  const V far_away = hn::Set(d, std::numeric_limits<double>::max());
  Hits<double> hits;
  for (std::size_t i = 0; i < samples.count; i += lanes) {
    const auto active = hn::FirstN(d, samples.count - i);
    const V3<V> direction =
        eye.direction(d, 0, 0, hn::IfThenElseZero(active, hn::Load(d, samples.x + i)),
                      hn::Neg(hn::IfThenElseZero(active, hn::Load(d, samples.y + i))));
    const Hit<V> hit = find_followed(d, scene, origin, direction, far_away, active);
    store(d, direction, hit, hn::Iota(d, static_cast<double>(i)), active, scene.has_own_normals, i,
          hits);
  }
  if (cover != nullptr)
    for (std::size_t i = 0; i < samples.count; ++i)
      cover[samples.index[i]] = hits.id[i] < 0 ? 0.0F : 1.0F;
  RayQueues<double> queues(scene);
  shade_hits(d, eye, hits, (samples.count + lanes - 1) / lanes, light_sets, false, queues, colours);
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
