// Light from infinitely far away, for packets of points.

#include <limits>

#include "engine/lights/packet_light.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE ArrivingLights<V> arriving(D d, std::type_identity<DistantLight>,
                                      const PacketLight<T>& light, const V3<V>& /*points*/) {
  return {broadcast(d, light.place), broadcast(d, light.emission),
          hn::Set(d, std::numeric_limits<T>::max())};
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
