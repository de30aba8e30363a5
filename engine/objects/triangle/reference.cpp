// Where a ray meets a triangle: the definition, in double and one ray at a time.
#include <algorithm>

#include "engine/math/ray_plane.h"
#include "engine/objects/triangle/triangle.h"

namespace raytracer {
namespace {

/// A corner in the plane across the ray, which passes through its origin.
struct ProjectedPoint {
  double u;
  double v;
};

/// On which side of the line from p to q the ray passes: the sign of a difference of two rounded
/// products, which is right or 0 (rounding keeps their order), and opposite for q and p.
double side_of_line(const ProjectedPoint& p, const ProjectedPoint& q) {
  return p.u * q.v - p.v * q.u;
}

}  // namespace

std::optional<SurfaceHit> intersect(const Ray& ray, const PackedTriangle& triangle) {
  const Vec3 origin = ray.origin.point();
  const auto& corners = triangle.vertices;
  const OrthonormalBasis plane = orthonormal_basis(ray.direction);
  const auto project = [&](const Vec3& corner) {
    const Vec3 from_origin = corner - origin;
    return ProjectedPoint{dot(plane.u, from_origin), dot(plane.v, from_origin)};
  };
  const ProjectedPoint a = project(corners[0]);
  const ProjectedPoint b = project(corners[1]);
  const ProjectedPoint c = project(corners[2]);
  const double ab = side_of_line(a, b);
  const double bc = side_of_line(b, c);
  const double ca = side_of_line(c, a);
  const bool left = ab >= 0 && bc >= 0 && ca >= 0;
  const bool right = ab <= 0 && bc <= 0 && ca <= 0;
  if (!left && !right) return {};

  if (ray.origin.side == SurfacePoint::Side::flat &&
      std::all_of(corners.begin(), corners.end(),
                  [&](const Vec3& corner) { return height_over_surface(ray.origin, corner) <= 0; }))
    return {};
  const auto hit = intersect_plane(ray, corners[0], triangle.normal);
  if (!hit) return {};
  SurfacePoint point = flat_point(triangle.id, ray, hit->t, corners[0], hit->normal);
  point.is_inside = dot(hit->normal, triangle.normal) < 0;
  const double area = ab + bc + ca;
  point.weights = area != 0 ? Vec3{bc, ca, ab} / area : Vec3{1, 0, 0};
  return SurfaceHit{hit->t, point};
}

}  // namespace raytracer
