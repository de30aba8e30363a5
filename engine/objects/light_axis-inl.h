// Two opposite directions that rays to a sky share. No functions: HWY_BEFORE_NAMESPACE would have
// nothing to apply to, of which clang warns.

#include "engine/lights/packet_light.h"

namespace raytracer::HWY_NAMESPACE {

/// A direction that rays to a soft light share; of a sky's the lanes of a packet may look to either
/// end.
template <class D, typename T = hn::TFromD<D>>
struct LightAxis {
  const PacketLight<T>& light;
  const PacketLight<T>* opposite;  ///< none of a disc
  hn::Mask<D> opposite_lanes;      ///< those that look there
  const PointBox<T>& box;          ///< of the packet's points
};

}  // namespace raytracer::HWY_NAMESPACE
