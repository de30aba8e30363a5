// Light from a point, for packets of points.

#include <limits>

#include "engine/lights/packet_light.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE ArrivingLights<V> arriving(D d, std::type_identity<PointLight>,
                                      const PacketLight<T>& light, const V3<V>& points) {
  const V most = hn::Set(d, std::numeric_limits<T>::max() / T(1e6));
  const V3<V> path = sub(broadcast(d, light.place), points);
  const V square = dot(path, path);
  const V inverse_square =
      hn::Div(hn::Set(d, T(1)), hn::Max(square, hn::Set(d, std::numeric_limits<T>::min())));
  V3<V> emission = broadcast(d, light.emission);
  if (light.fades) emission = scale(emission, inverse_square);
  return {scale(path, hn::Sqrt(inverse_square)),
          {hn::Min(emission.x, most), hn::Min(emission.y, most), hn::Min(emission.z, most)},
          hn::Sqrt(square)};
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
