#include "engine/objects/axial_reference.h"

#include <cmath>

#include "engine/math/ray_plane.h"

namespace raytracer {

AxialLeft left_surface(const Ray& ray, const AxialSolid& c) {
  const SurfacePoint& from = ray.origin;
  if (!from.is_on_surface(c.id)) return {};
  if (from.part == side_part)
    return {true, side_part, from.side == SurfacePoint::Side::round_inside};
  const double outward = from.part == to_part ? 1 : -1;
  return {true, from.part, outward * dot(from.normal, c.axis) < 0};
}

AxialRay::AxialRay(const Ray& ray, const AxialSolid& c, double share) {
  const SurfacePoint& from = ray.origin;
  const Vec3 delta = from.anchor - c.foot;
  const double delta_along = dot(delta, c.axis);
  const double offset_along = dot(from.offset, c.axis);
  f = share * ((delta - delta_along * c.axis) + (from.offset - offset_along * c.axis));
  k = share * cross(ray.direction, c.axis);
  g = cross(c.axis, k);
  x = dot(f, k);
  along = delta_along + offset_along;
  slope = dot(ray.direction, c.axis);
  reach = max_abs(from.anchor) + max_abs(c.foot) + from.radius;
}

EndPlanes::EndPlanes(double to_low, double to_high, double slope) {
  if (slope == 0) {
    is_between = to_low <= 0 && to_high >= 0;
    return;
  }
  enter = (slope > 0 ? to_low : to_high) / slope;
  leave = (slope > 0 ? to_high : to_low) / slope;
}

EndPlanes planes_around(const AxialRay& r, const AxialSolid& c) {
  return {std::min(c.low - r.along, 0.0), std::max(c.high - r.along, 0.0), r.slope};
}

EndPlanes planes_before(const AxialRay& r, const Ray& ray, const AxialSolid& c,
                        const AxialLeft& left) {
  const SurfacePoint& from = ray.origin;
  double to_low = c.low - r.along;
  double to_high = c.high - r.along;
  // What leaves a plane, another cap's too, is told from coplanar caps by exact points.
  if (!left.is_left && leaves_parallel(from, c.axis)) {
    const double sign = std::copysign(1.0, dot(from.normal, c.axis));
    to_low = sign * height_over_surface(from, c.end(false));
    to_high = sign * height_over_surface(from, c.end(true));
  }
  if (left.is_left) (left.part == from_part ? to_low : to_high) = 0;
  return {to_low, to_high, r.slope};
}

AxialHit on_cap(const AxialRay& r, const AxialSolid& c, double t, bool is_leave) {
  const bool is_to = (r.slope > 0) == is_leave;
  return {t, is_to ? to_part : from_part, is_leave, is_to ? c.axis : -c.axis};
}

std::optional<SurfaceHit> surface_hit(const Ray& ray, const AxialSolid& c,
                                      const std::optional<AxialHit>& hit) {
  if (!hit || !(hit->t > 0)) return {};
  SurfacePoint point;
  if (hit->part == side_part) {
    point =
        round_point(c.id, c.foot + hit->along * c.axis, hit->radius, hit->aside, hit->is_inside);
    point.normal = hit->is_inside ? -unit(hit->outward) : unit(hit->outward);
  } else {
    point = flat_point(c.id, ray, hit->t, c.end(hit->part == to_part),
                       hit->is_inside ? -hit->outward : hit->outward);
  }
  point.part = hit->part;
  point.is_inside = hit->is_inside;
  point.has_inside = c.has_caps;
  return SurfaceHit{hit->t, point};
}

}  // namespace raytracer
