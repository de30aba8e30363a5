// Light from infinitely far away, for packets of points.

#if defined(RAYTRACER_LIGHTS_DISTANT_DISTANT_LIGHT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_LIGHTS_DISTANT_DISTANT_LIGHT_INL_H_
#undef RAYTRACER_LIGHTS_DISTANT_DISTANT_LIGHT_INL_H_
#else
#define RAYTRACER_LIGHTS_DISTANT_DISTANT_LIGHT_INL_H_
#endif

#include <limits>

#include "engine/lights/arriving-inl.h"
#include "engine/lights/packet_light.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE ArrivingLights<V> arriving(D d, std::type_identity<DistantLight>,
                                      const PacketLight<T>& light, const V3<V>& /*points*/) {
  return {broadcast(d, light.place), broadcast(d, light.emission),
          hn::Set(d, std::numeric_limits<T>::max())};
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
