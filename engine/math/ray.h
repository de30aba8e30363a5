// Rays that remember the surface they leave, so that no epsilon is needed to leave it.
//
// A point on a sphere is kept as centre + offset: differences of centres are then rounded once,
// however far the sphere is from the coordinates' origin, and a convex surface is known not to
// hit itself (see "Leaving a surface" in each kernel/ intersection).
#pragma once

#include <compare>
#include <cstdint>

#include "engine/math/vec.h"

namespace raytracer {

/// What was hit: an object of the document and its part (a sphere of a set or square, a triangle
/// of a mesh, else 0). The order is the document's, which decides between equal distances.
struct PrimitiveId {
  std::uint32_t object = 0;
  std::uint64_t part = 0;

  friend auto operator<=>(const PrimitiveId&, const PrimitiveId&) = default;
};

/// Where a ray starts: the eye, or a point on a surface seen from one side.
struct Departure {
  enum class Surface { none, sphere_outside, sphere_inside, flat };

  Surface surface = Surface::none;
  PrimitiveId id;     ///< of the surface, if there is one
  Vec3 anchor;        ///< the sphere's centre; else the point itself
  Vec3 offset;        ///< from the anchor to the point: zero but for spheres
  double radius = 0;  ///< of the sphere; else 0
  Vec3 normal;        ///< unit, towards the side that the ray leaves to
  Vec3 flat_point;    ///< flat: an exact point of the plane (`anchor` is a rounded one)

  Vec3 point() const { return anchor + offset; }
};

struct Ray {
  Departure from;
  Vec3 direction;  ///< unit
};

}  // namespace raytracer
