// Where a ray meets a cylinder: the definition, in double and one ray at a time.
#include <algorithm>
#include <cmath>

#include "engine/math/ray_plane.h"
#include "engine/objects/cylinder/cylinder.h"

namespace raytracer {
namespace {

// Its surfaces, as SurfacePoint::part has them.
constexpr int side_part = 0;
constexpr int from_part = 1;  // the cap at `from`
constexpr int to_part = 2;

struct CylinderHit {
  double t;
  int part;
  bool is_inside;  ///< the ray meets the back
  Vec3 outward;    ///< unit normal, out of the solid
  double along;    ///< of the hit along the axis, from the foot
};

/// How the ray leaves this very cylinder, if it does.
struct CylinderLeft {
  bool is_left = false;
  int part = side_part;
  bool from_inside = false;
};

CylinderLeft left_surface(const Ray& ray, const PackedCylinder& c) {
  const SurfacePoint& from = ray.origin;
  if (!from.is_on_surface(c.id)) return {};
  if (from.part == side_part)
    return {true, side_part, from.side == SurfacePoint::Side::round_inside};
  const double outward = from.part == to_part ? 1 : -1;
  return {true, from.part, outward * dot(from.normal, c.axis) < 0};
}

/// From where to where along the ray: empty unless enter <= leave.
struct Span {
  double enter = infinity;
  double leave = -infinity;
};

/// The ray seen along the axis: what is across it, and along it.
struct Crossing {
  Vec3 f;        ///< from the axis to the ray's origin, across the axis
  Vec3 k;        ///< direction x axis: across both
  Vec3 e;        ///< the direction's part across the axis, exactly as k
  double a;      ///< |e|^2 = |k|^2
  double x;      ///< sqrt(a) times the distance of the two lines
  double b;      ///< -f.e: a times the distance along the ray to where it is nearest to the axis
  double along;  ///< of the origin, from the foot
  double slope;  ///< direction . axis
  double reach;  ///< what is rounded is no larger
};

Crossing crossing_of(const Ray& ray, const PackedCylinder& c) {
  const SurfacePoint& from = ray.origin;
  const Vec3 delta = from.anchor - c.foot;
  const double delta_along = dot(delta, c.axis);
  const double offset_along = dot(from.offset, c.axis);
  Crossing r;
  r.f = (delta - delta_along * c.axis) + (from.offset - offset_along * c.axis);
  r.k = cross(ray.direction, c.axis);
  r.e = cross(c.axis, r.k);
  r.a = dot(r.k, r.k);
  r.x = dot(r.f, r.k);
  r.b = 0 - dot(r.f, r.e);  // never -0: the roots are told apart by its sign
  r.along = delta_along + offset_along;
  r.slope = dot(ray.direction, c.axis);
  r.reach = max_abs(from.anchor) + max_abs(c.foot) + from.radius;
  return r;
}

/// Where the ray is within the endless cylinder; `power` is |f|^2 - r^2.
Span within_side(const Crossing& r, double radius, double power) {
  if (r.a == 0) return power <= 0 ? Span{-infinity, infinity} : Span{};
  const double room = radius * radius * r.a - r.x * r.x;
  if (!(room >= 0)) return {};
  const double s = std::sqrt(room);
  const double q = r.b + std::copysign(s, r.b);
  if (q == 0) return {0, 0};
  const double one = power / q;
  const double other = q / r.a;
  return r.b >= 0 ? Span{one, other} : Span{other, one};
}

/// Where the ray is between the planes of the ends, which are that far along the axis.
Span between_ends(double to_low, double to_high, double slope) {
  if (slope == 0) return to_low <= 0 && to_high >= 0 ? Span{-infinity, infinity} : Span{};
  return slope > 0 ? Span{to_low / slope, to_high / slope} : Span{to_high / slope, to_low / slope};
}

/// The normal from where the ray is nearest to the axis, (x / a) k from it: f + t e would lose as
/// many digits as the origin is radii away.
CylinderHit on_side(const Crossing& r, const PackedCylinder& c, double t, bool is_leave) {
  const double s = std::sqrt(std::max(c.radius * c.radius * r.a - r.x * r.x, 0.0));
  const Vec3 outward = r.x * r.k + (is_leave ? s : -s) * r.e;
  const double along = std::clamp(r.along + t * r.slope, c.low, c.high);
  return {t, side_part, is_leave, unit(outward), along};
}

CylinderHit on_cap(const Crossing& r, const PackedCylinder& c, double t, bool is_leave) {
  const bool is_to = (r.slope > 0) == is_leave;
  return {t, is_to ? to_part : from_part, is_leave, is_to ? c.axis : -c.axis,
          is_to ? c.high : c.low};
}

/// The nearest hit at t > 0.
std::optional<CylinderHit> intersect_cylinder(const Ray& ray, const PackedCylinder& c) {
  const CylinderLeft left = left_surface(ray, c);
  // Convex: what leaves its outside meets nothing of it again, open or closed.
  if (left.is_left && !left.from_inside) return {};
  const SurfacePoint& from = ray.origin;
  Crossing r = crossing_of(ray, c);

  const bool leaves_side = left.is_left && left.part == side_part;
  if (leaves_side) {
    const double b = -dot(from.offset, r.e);
    const Span ends =
        between_ends(std::min(c.low - r.along, 0.0), std::max(c.high - r.along, 0.0), r.slope);
    const double t = r.a > 0 ? std::max(2 * b / r.a, 0.0) : infinity;
    if (t <= ends.leave) {
      const double along = std::clamp(r.along + t * r.slope, c.low, c.high);
      return CylinderHit{t, side_part, true, unit(from.offset + t * r.e), along};
    }
    if (!c.has_caps) return {};
    return on_cap(r, c, std::max(ends.leave, 0.0), true);
  }

  double to_low = c.low - r.along;
  double to_high = c.high - r.along;
  // What leaves a plane, another cap's too, is told from coplanar caps by exact points.
  if (!left.is_left && from.side == SurfacePoint::Side::flat &&
      max_abs(cross(from.normal, c.axis)) <= 0x1p-50) {
    const double sign = std::copysign(1.0, dot(from.normal, c.axis));
    to_low = sign * height_over_surface(from, c.end(false));
    to_high = sign * height_over_surface(from, c.end(true));
  }
  if (left.is_left) (left.part == from_part ? to_low : to_high) = 0;

  // Of the eye it is known; else it is rounding where it is less than the place is rounded by.
  double power = c.eye_c;
  bool is_on_side = false;
  if (from.side != SurfacePoint::Side::none) {
    power = dot(r.f, r.f) - c.radius * c.radius;
    is_on_side = std::abs(power) <= 8 * rounding_of_doubles * r.reach * c.radius;
    if (is_on_side) power = 0;
    if (left.is_left) power = std::min(power, 0.0);  // it starts inside, on a cap
  }

  const Span side = within_side(r, c.radius, power);
  const Span ends = between_ends(to_low, to_high, r.slope);
  if (!c.has_caps) {
    const auto is_between = [&](double t) { return t > 0 && ends.enter <= t && t <= ends.leave; };
    if (!(side.enter <= side.leave)) return {};
    if (is_between(side.enter)) return on_side(r, c, side.enter, false);
    if (is_between(side.leave)) return on_side(r, c, side.leave, true);
    return {};
  }
  const double enter = std::max(side.enter, ends.enter);
  const double leave = std::min(side.leave, ends.leave);
  if (left.is_left) {  // from the inside of a cap: it leaves through something
    const double t = std::max(leave, 0.0);
    return side.leave <= ends.leave ? on_side(r, c, t, true) : on_cap(r, c, t, true);
  }
  if (!(enter <= leave)) return {};
  const bool starts_on_it = is_on_side && enter == 0 && leave > 0;  // and goes in
  if (enter > 0 || starts_on_it)
    return side.enter >= ends.enter ? on_side(r, c, enter, false) : on_cap(r, c, enter, false);
  if (!(leave > 0)) return {};
  return side.leave <= ends.leave ? on_side(r, c, leave, true) : on_cap(r, c, leave, true);
}

}  // namespace

std::optional<SurfaceHit> intersect(const Ray& ray, const PackedCylinder& c) {
  const auto hit = intersect_cylinder(ray, c);
  if (!hit || !(hit->t > 0)) return {};
  SurfacePoint point;
  if (hit->part == side_part)
    point = round_point(c.id, c.foot + hit->along * c.axis, c.radius, hit->outward, hit->is_inside);
  else
    point = flat_point(c.id, ray, hit->t, c.end(hit->part == to_part),
                       hit->is_inside ? -hit->outward : hit->outward);
  point.part = hit->part;
  point.is_inside = hit->is_inside;
  point.has_inside = c.has_caps;
  return SurfaceHit{hit->t, point};
}

}  // namespace raytracer
