// Rays and primitives by hand, for tests of the kernels.
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "engine/pack/packed_scene.h"
#include "engine/reference/query.h"

namespace raytracer::test {

/// A ray from a point on no surface.
inline Ray ray_from(const Vec3& origin, const Vec3& direction) {
  Ray ray{SurfacePoint{}, unit(direction)};
  ray.origin.anchor = origin;
  return ray;
}

inline Ray ray_towards(const Vec3& origin, const Vec3& target) {
  return ray_from(origin, target - origin);
}

/// A ray that leaves the surface that a query has found.
inline Ray ray_leaving(const SurfacePoint& point, const Vec3& direction) {
  return {point, unit(direction)};
}

/// The same numbers on every machine and run.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  /// Evenly between the two.
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits_() >> 11) * 0x1p-53);
  }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(bits_() % count); }
  Vec3 point(double low, double high) {
    const double x = between(low, high);
    const double y = between(low, high);
    return {x, y, between(low, high)};
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 inside = point(-1, 1);
      if (length(inside) <= 1 && length(inside) > 0.1) return unit(inside);
    }
  }
  /// 10^U(low, high), of either sign.
  double magnitude(double low, double high) {
    const double size = std::pow(10, between(low, high));
    return below(2) == 0 ? size : -size;
  }

 private:
  std::mt19937_64 bits_;
};

inline PackedTriangle packed_triangle(const Vec3& a, const Vec3& b, const Vec3& c, PrimitiveId id) {
  return {{a, b, c}, unit(cross(unit(b - a), unit(c - a))), id};
}

}  // namespace raytracer::test
