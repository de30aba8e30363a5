#include "engine/kernel/flat.h"

#include <algorithm>
#include <cmath>

namespace raytracer {
namespace {

constexpr double rounding = 0x1p-53;

/// A corner in the plane across the ray, which passes through its origin.
struct Point {
  double u;
  double v;
};

/// On which side of the line from p to q the ray passes: the sign of a difference of two rounded
/// products, which is right or 0 (rounding keeps their order), and opposite for q and p.
double side(const Point& p, const Point& q) { return p.u * q.v - p.v * q.u; }

/// How far `point` lies on the side of the departure's plane that the ray leaves to; 0 if that
/// is less than the rounding of the coordinates.
double height_over(const Departure& from, const Vec3& point) {
  const double height = dot(from.normal, point - from.flat_point);
  const double noise = 16 * rounding * (max_abs(point) + max_abs(from.flat_point));
  return std::abs(height) <= noise ? 0 : height;
}

/// Whether the ray leaves a plane that is parallel to the one with this normal.
bool leaves_parallel(const Departure& from, const Vec3& normal) {
  constexpr double parallel = 0x1p-50;
  return from.surface == Departure::Surface::flat &&
         max_abs(cross(from.normal, normal)) <= parallel;
}

/// The distance along the ray to the plane through `point`, if it is met.
std::optional<FlatHit> intersect(const Ray& ray, const Vec3& point, const Vec3& normal) {
  const Departure& from = ray.from;
  const double height =
      leaves_parallel(from, normal)
          ? std::copysign(1.0, dot(normal, from.normal)) * height_over(from, point)
          : dot(normal, point - from.anchor) - dot(normal, from.offset);
  const double slope = dot(normal, ray.direction);
  const double t = height / slope;
  if (!(t > 0) || std::isinf(t)) return {};
  return FlatHit{t, slope > 0 ? -normal : normal};
}

}  // namespace

std::optional<FlatHit> intersect_plane(const Ray& ray, const PackedPlane& plane) {
  if (ray.from.surface == Departure::Surface::flat && ray.from.id == plane.id) return {};
  return intersect(ray, plane.point, plane.normal);
}

std::optional<FlatHit> intersect_triangle(const Ray& ray, const PackedTriangle& triangle) {
  const Vec3 origin = ray.from.point();
  const auto& corners = triangle.vertices;
  const Across plane = across(ray.direction);
  const auto project = [&](const Vec3& corner) {
    const Vec3 from_origin = corner - origin;
    return Point{dot(plane.u, from_origin), dot(plane.v, from_origin)};
  };
  const Point a = project(corners[0]);
  const Point b = project(corners[1]);
  const Point c = project(corners[2]);
  const double ab = side(a, b);
  const double bc = side(b, c);
  const double ca = side(c, a);
  const bool left = ab >= 0 && bc >= 0 && ca >= 0;
  const bool right = ab <= 0 && bc <= 0 && ca <= 0;
  if (!left && !right) return {};

  if (ray.from.surface == Departure::Surface::flat &&
      std::all_of(corners.begin(), corners.end(),
                  [&](const Vec3& corner) { return height_over(ray.from, corner) <= 0; }))
    return {};
  return intersect(ray, corners[0], triangle.normal);
}

}  // namespace raytracer
