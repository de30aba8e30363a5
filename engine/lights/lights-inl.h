// Every kind of light for packets of points: the list of lights.h once more.

#include "engine/lights/arriving-inl.h"
#include "engine/lights/distant/distant_light-inl.h"
#include "engine/lights/point/point_light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

template <class D, class Kind, class... Rest, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE ArrivingLights<V> arriving_light(D d, Types<Kind, Rest...>, std::size_t kind,
                                            const PacketLight<T>& light, const V3<V>& points) {
  if constexpr (!(ShinesFromEverywhere<Rest> && ...))
    if (light.kind != kind) return arriving_light(d, Types<Rest...>(), kind + 1, light, points);
  return arriving(d, std::type_identity<Kind>(), light, points);
}

/// What of a light arrives at the lanes' points.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE ArrivingLights<V> arriving_light(D d, const PacketLight<T>& light, const V3<V>& points) {
  return arriving_light(d, LightKinds(), 0, light, points);
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
