// Packets against surfaces of revolution between the ends of an axis: what kinds' own code begins
// with. What is the same for all of them once they have told their numbers is in
// axial_kinds-inl.h.

#include "engine/objects/axial_packets.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Solids, one for each lane's ray, or the same in all lanes. Constructors write each number where
/// it stays: a base that is copied from a function's result would be stored twice.
template <class V>
struct AxialLanes {
  V3<V> across;
  V3<V> towards;
  V3<V> axis;
  V distance;
  V low;
  V high;
  V has_caps;
  V id;

  template <class D, typename T>
  HWY_INLINE AxialLanes(D d, const AxialItem<T>& c)
      : across(broadcast(d, c.across)),
        towards(broadcast(d, c.towards)),
        axis(broadcast(d, c.axis)),
        distance(hn::Set(d, c.distance)),
        low(hn::Set(d, c.low)),
        high(hn::Set(d, c.high)),
        has_caps(hn::Set(d, c.has_caps)),
        id(hn::Set(d, c.id)) {}

  /// Those of a block: `get` takes a column to a vector.
  template <typename T, class Get>
  HWY_INLINE AxialLanes(const AxialBlock<T>& block, const Get& get)
      : across{get(block.axes[0]), get(block.axes[1]), get(block.axes[2])},
        towards{get(block.axes[3]), get(block.axes[4]), get(block.axes[5])},
        axis{get(block.axes[6]), get(block.axes[7]), get(block.axes[8])},
        distance(get(block.distance)),
        low(get(block.low)),
        high(get(block.high)),
        has_caps(get(block.has_caps)),
        id(get(block.id)) {}
};

/// In a solid's own axes: across, towards and axis.
template <class V>
struct InAxes {
  V u;
  V v;
  V w;
};
template <class V>
HWY_INLINE InAxes<V> direction_along(const AxialLanes<V>& c, const V3<V>& a) {
  return {dot(c.across, a), dot(c.towards, a), dot(c.axis, a)};
}
/// From the foot.
template <class V>
HWY_INLINE InAxes<V> place_along(const AxialLanes<V>& c, const V3<V>& a) {
  return {dot(c.across, a), hn::Sub(dot(c.towards, a), c.distance), dot(c.axis, a)};
}
/// The same of the eye.
template <class D, class V>
HWY_INLINE InAxes<V> eye_along(D d, const AxialLanes<V>& c) {
  return {hn::Zero(d), hn::Neg(c.distance), hn::Zero(d)};
}

/// What is rounded of a place is no larger.
template <class V>
HWY_INLINE V rounded_reach(const AxialLanes<V>& c, const InAxes<V>& f, const V3<V>&) {
  return hn::Add(hn::Add(hn::Abs(f.u), hn::Abs(f.v)), hn::Add(hn::Abs(f.w), c.distance));
}

/// Positive where a normal in the surface of a closed solid looks outwards. `f` is from the middle:
/// of what is convex all is on the inner side of any surface.
template <class V>
HWY_INLINE V outwards(const AxialLanes<V>&, const InAxes<V>& f, const InAxes<V>& n) {
  return hn::MulAdd(f.u, n.u, hn::MulAdd(f.v, n.v, hn::Mul(f.w, n.w)));
}

/// Where rays are within closed solids.
template <class V, class M>
struct AxialChord {
  M is_there;
  V enter;
  V leave;
  M enters_cap;  ///< not through the side
};

/// Where rays pass through the sides of open solids, between their ends.
template <class V, class M>
struct SideHits {
  M enters;
  M leaves;
  V enter;
  V leave;
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
