// Light as packets of points see it.

#if defined(RAYTRACER_LIGHTS_ARRIVING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_LIGHTS_ARRIVING_INL_H_
#undef RAYTRACER_LIGHTS_ARRIVING_INL_H_
#else
#define RAYTRACER_LIGHTS_ARRIVING_INL_H_
#endif

#include "engine/packets/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// Of one light.
template <class V>
struct ArrivingLights {
  V3<V> towards;   ///< unit
  V3<V> emission;  ///< that arrives; finite
  V path;          ///< the distance; the largest number if that is infinite
};

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
