// The colours of a packet of points.

#include "engine/math/tolerances.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// What stands before a light where no surface lets any through: that hides it.
struct OpaqueSurfaces {
  static constexpr bool hides_all = true;

  /// Lanes of `lit` that the light reaches.
  template <class D, class Light, class V = hn::Vec<D>, class M = hn::Mask<D>,
            typename T = hn::TFromD<D>>
  HWY_INLINE M reached(D d, const PacketScene<T>& scene, const Light& light,
                       const ShadowRays<V>& rays, M lit) const {
    return hn::AndNot(occluded(d, scene, light, rays, lit), lit);
  }
  /// How much of a place on a soft light, which rays do not share, the lanes of `lit` have.
  template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
  HWY_INLINE V share_along(D d, const PacketScene<T>& scene, const ShadowRays<V>& rays,
                           M lit) const {
    return hn::IfThenElseZero(hn::AndNot(occluded_followed(d, scene, rays, lit), lit),
                              hn::Set(d, T(1)));
  }
  /// What is left of the light that would arrive.
  template <class V>
  HWY_INLINE V weakened(V share) const {
    return share;
  }
};

/// Points that face a light: one that shines along a surface shines on no side of it, whatever
/// rounding makes of the point, the surface and the direction.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M faces(D d, const V3<V>& point, const ArrivingLights<V>& arriving, V incidence) {
  const V size = hn::Add(hn::Abs(point.x), hn::Add(hn::Abs(point.y), hn::Abs(point.z)));
  const V noise = hn::Set(d, sine_noise<T>);
  return hn::Gt(hn::Mul(incidence, arriving.path), hn::Mul(noise, hn::Add(arriving.path, size)));
}

/// The colour of the packet's points, without what they mirror or show behind them; rubbish in
/// lanes not `active`. `between` tells what stands before a light; `light_set` is of places on soft
/// ones.
template <class D, class Between, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE V3<V> shade(D d, const PacketScene<T>& scene, const Surface<D>& surface,
                       const V3<V>& view, M active, const LightSet<T>& light_set,
                       Between&& between) {
  const RayOrigin<V>& point = surface.at;
  const V zero = hn::Zero(d);
  if (HWY_UNLIKELY(light_set.is_recorded())) {
    record_points(d, surface, active, light_set);
    return {zero, zero, zero};
  }
  const MaterialPacket<D> material(d, scene.materials, surface.material, surface.normal, view);
  const bool ambient_needs_light = scene.shadows == Shadows::black;

  const V unlit = ambient_needs_light ? zero : material.ambient;
  V3<V> sum{unlit, unlit, unlit};
  for (const PacketLight<T>& light : scene.lights) {
    const ArrivingLights<V> arriving = arriving_light(d, light, point.point);
    const V incidence = dot(surface.normal, arriving.towards);
    M lit = hn::And(active, faces(d, point.point, arriving, incidence));
    if (!scene.corners.empty())
      lit = hn::And(lit, hn::Gt(dot(point.normal, arriving.towards), zero));
    if (hn::AllFalse(d, lit)) continue;
    if (scene.shadows != Shadows::off) {
      const ShadowRays<V> rays{point, arriving.towards, arriving.path, incidence};
      lit = between.reached(d, scene, light, rays, lit);
      if (hn::AllFalse(d, lit)) continue;
    }
    const V share =
        hn::IfThenElseZero(lit, between.weakened(material.share(d, arriving.towards, incidence)));
    const V ambient = ambient_needs_light ? hn::IfThenElseZero(lit, material.ambient) : zero;
    sum = add(sum, mul_add(arriving.emission, share, V3<V>{ambient, ambient, ambient}));
  }
  if (HWY_UNLIKELY(!scene.soft_lights.empty()))
    sum = add(sum,
              soft_light(d, scene, surface, material, ambient_needs_light ? material.ambient : zero,
                         active, light_set, between));
  const V3<V>& colour = surface.color;
  return {hn::Mul(sum.x, colour.x), hn::Mul(sum.y, colour.y), hn::Mul(sum.z, colour.z)};
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
