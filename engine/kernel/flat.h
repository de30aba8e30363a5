// Ray and plane, ray and triangle.
//
// A triangle's distance is its plane's, computed as a plane's is: a mesh lying in a plane ties
// with it exactly. Whether the ray passes inside is decided by the signs of the volumes of the
// ray with each edge; two triangles that share an edge compute the same volume with opposite
// sign, so no ray slips between them (Woop, Benthin, Wald: "Watertight Ray/Triangle
// Intersection", JCGT 2013, for the idea; here without its change of coordinates).
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
