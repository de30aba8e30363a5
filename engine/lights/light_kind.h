// What a kind of light has to tell the engine: each in its own folder beside this file, all of them
// listed once in lights.h and lights-inl.h. One whose rays share neither a direction nor their end
// would need a LightRays of its own, and with it a RayKind (finders/finder.h).
//
//   struct XLight {
//     ...                                        its fields: `type`, `description` and `fields`
//     static constexpr LightRays rays;           what the rays to it share
//   };
//   for_each_extent(x, include)                  include(point, reach): the space that it takes
//   place_of(x, frame)                           in frame coordinates: PackedLight::place
//   emission_of(x, i, frame)                     PackedLight::emission if colour times intensity is
//   i brightest(x, i, clearance)                   its light on the surface nearest to it
//   arriving<X>(light, point)                    the definition
//   arriving(d, std::type_identity<X>(), ...)    in X-inl.h: the same for packets
#pragma once

#include <cstdint>
#include <limits>

#include "engine/math/frame.h"
#include "engine/math/ray.h"
#include "engine/math/vec.h"

namespace raytracer {

/// What rays to a light share, by which finders look for what is in their way.
enum class LightRays : std::uint8_t {
  parallel,    ///< a direction
  converging,  ///< the point where they end
};

/// A light in frame coordinates.
struct PackedLight {
  std::size_t kind;  ///< its place in LightKinds
  LightRays rays;
  Vec3 place;    ///< parallel: unit vector towards the light; converging: where it is
  Rgb emission;  ///< i; of one whose light falls with the distance's square, at distance 1
};

/// A light as a point sees it.
struct ArrivingLight {
  Vec3 towards;     ///< unit; zero where the light is exactly at the point
  double distance;  ///< infinite if the rays are parallel
  Rgb intensity;    ///< that arrives; finite
};

/// The light that arrives at a point from one of this kind: the definition, in double.
template <typename Light>
ArrivingLight arriving(const PackedLight& light, const SurfacePoint& point);

}  // namespace raytracer
