// Light as packets of points see it.

namespace raytracer::HWY_NAMESPACE {

/// Of one light.
template <class V>
struct ArrivingLights {
  V3<V> towards;   ///< unit
  V3<V> emission;  ///< that arrives; finite
  V path;          ///< the distance; the largest number if that is infinite
};

}  // namespace raytracer::HWY_NAMESPACE
