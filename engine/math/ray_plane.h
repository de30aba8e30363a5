// Ray and plane, of planes and of what is flat.
//
// Leaving a surface: a ray that leaves a plane to one side cannot meet what lies in the plane or on
// its other side. That is asked of exact points, a triangle's corners or a plane's own, not of the
// ray's origin, which is rounded.
#pragma once

#include <optional>

#include "engine/math/ray.h"

namespace raytracer {

struct PlaneHit {
  double t;
  Vec3 normal;  ///< unit, turned towards the ray's origin
};

/// Where the ray meets the plane through `point` across `normal`, at t > 0.
std::optional<PlaneHit> intersect_plane(const Ray& ray, const Vec3& point, const Vec3& normal);

/// Whether a ray from there leaves a plane that is parallel to the one across `normal`, a unit
/// vector.
bool leaves_parallel(const SurfacePoint& from, const Vec3& normal);

/// How far `point` lies on the side of the flat surface that a ray leaves to; 0 if that is less
/// than the rounding of the coordinates.
double height_over_surface(const SurfacePoint& from, const Vec3& point);

}  // namespace raytracer
