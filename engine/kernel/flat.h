// Ray and plane, ray and triangle.
//
// A triangle's distance is its plane's, computed as a plane's is: a mesh lying in a plane ties
// with it exactly. Whether the ray passes inside is decided in the plane across it: a corner that
// two triangles share is projected to the same point for both, and an edge that they share gives
// opposite signs, which rounding can make 0 but never wrong, so no ray slips between them (Woop,
// Benthin, Wald: "Watertight Ray/Triangle Intersection", JCGT 2013; here with an orthonormal
// basis around the ray instead of a shear).
//
// Leaving a surface: a ray that leaves a plane to one side cannot meet what lies in the plane or
// on its other side. That is asked of the triangle's corners, which are exact, not of the ray's
// origin, which is rounded.
#pragma once

#include <optional>

#include "engine/math/ray.h"
#include "engine/pack/packed_scene.h"

namespace raytracer {

struct FlatHit {
  double t;
  Vec3 normal;  ///< unit, turned towards the ray's origin
};

std::optional<FlatHit> intersect_plane(const Ray& ray, const PackedPlane& plane);

std::optional<FlatHit> intersect_triangle(const Ray& ray, const PackedTriangle& triangle);

}  // namespace raytracer
