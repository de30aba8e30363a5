// Ray and square of touching spheres, at a cost that does not depend on how many there are.
//
// The square's spheres stand in rows. Rows run along that spanning axis to which the ray is more
// nearly parallel, so that it crosses few; within a row the spheres that it meets are found by a
// formula: the ray is closest to the row's axis, at distance delta, above the point x*, and a
// centre at x on the axis is at distance sqrt(delta^2 + (x - x*)^2 sin^2) from the ray, sin being
// that of the angle between ray and row. Centres are computed from their indices, never by
// adding up.
//
// Limits: a ray that lies in the square's own plane and misses every sphere on its way visits
// every row that it crosses.
#pragma once

#include <optional>

#include "engine/kernel/sphere.h"
#include "engine/math/ray.h"
#include "engine/pack/packed_scene.h"

namespace raytracer {

struct SquareHit {
  SphereHit sphere;
  std::uint64_t part;  ///< which of the spheres: first index * side + second
  Vec3 center;
};

/// The nearest hit at t > 0.
std::optional<SquareHit> intersect_square(const Ray& ray, const PackedSquare& square);

}  // namespace raytracer
