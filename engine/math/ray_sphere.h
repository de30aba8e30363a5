// Ray and sphere.
//
// In the residual form that keeps its accuracy at a distance: the discriminant is taken from the
// part of the centre's offset that is perpendicular to the ray, and the roots from C = |f|^2 - r^2
// and q = b + sign(b) s, which do not cancel (Haines, Guenther, Akenine-Moeller: "Precision
// Improvements for Ray/Sphere Intersection", Ray Tracing Gems 2019, chapter 7). C is the only
// difference left that can cancel, where a ray starts near the surface; it is then summed with
// compensation.
//
// Leaving a surface: from outside, a ray cannot meet the sphere that it leaves (convexity); from
// inside, it meets it at t = -2 r (n.d). Both are exact and need no epsilon.
#pragma once

#include <optional>

#include "engine/math/ray.h"

namespace raytracer {

struct SphereHit {
  double t;
  Vec3 outward;    ///< unit normal at the hit, away from the centre
  bool is_inside;  ///< the ray meets the sphere's back
};

/// The nearest hit at t > 0. `is_left`: the ray leaves this sphere's surface.
std::optional<SphereHit> intersect_sphere(const Ray& ray, const Vec3& center, double radius,
                                          bool is_left);

}  // namespace raytracer
