// Paths that are carried in double: single finds what their rays meet and shades it, but what it
// rounds off where they turn would be magnified by each curved mirror or lens that follows.
//
// A ray's error grows as the distance of two neighbouring rays does (Igehy: "Tracing Ray
// Differentials", 1999): over a distance by its error of direction, at a curved surface by the turn
// of the normal. What a ray finds is off by what single rounds off on its way alone.

#include <type_traits>

#include "engine/kernel/exact_scene.h"
#include "engine/kernel/ray_columns.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Whether packets of T may have paths that are carried in double.
template <typename T>
inline constexpr bool may_be_inexact = std::is_same_v<T, float>;

/// What single rounds off of where rays begin and of their directions.
template <class V>
struct RayRest {
  V3<V> point;
  V3<V> direction;
};

/// What else double wants to know of a packet's way to a surface, to tell how it goes on.
template <class V>
struct WayTo {
  RayRest<V> rest;
  V t;                ///< to the surface
  V side;             ///< on which it meets that, as tell_sides() has it, where rays branch
  V left_id;          ///< of the surface where the way begins
  V3<V> left_normal;  ///< its normal there
};

/// Turns rays where they meet what they have come to. What is to be done in double is compiled with
/// the kernels that are, once.
void turn_in_double(const PacketScene<double>& scene, const TurningRays& rays);

/// The lanes whose points are beyond a light's reach.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE M beyond_reach(D d, const ExactScene& exact, const V3<V>& point) {
  M beyond = hn::Lt(hn::Zero(d), hn::Zero(d));
  for (const LampReach& lamp : exact.lamps) {
    const V3<V> path = sub(point, broadcast(d, lamp.place));
    beyond = hn::Or(beyond, hn::Gt(dot(path, path), hn::Set(d, lamp.reach2)));
  }
  return beyond;
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
