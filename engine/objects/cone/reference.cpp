// Where a ray meets a cone: the definition, in double and one ray at a time.
#include <algorithm>
#include <cmath>

#include "engine/math/ray_plane.h"
#include "engine/objects/cone/cone.h"

namespace raytracer {
namespace {

// Its surfaces, as SurfacePoint::part has them.
constexpr int side_part = 0;
constexpr int from_part = 1;  // the cap at `from`
constexpr int to_part = 2;

/// How the ray leaves this very cone, if it does.
struct ConeLeft {
  bool is_left = false;
  int part = side_part;
  bool from_inside = false;
};

ConeLeft left_surface(const Ray& ray, const PackedCone& c) {
  const SurfacePoint& from = ray.origin;
  if (!from.is_on_surface(c.id)) return {};
  if (from.part == side_part)
    return {true, side_part, from.side == SurfacePoint::Side::round_inside};
  const double outward = from.part == to_part ? 1 : -1;
  return {true, from.part, outward * dot(from.normal, c.axis) < 0};
}

/// The ray as cone.h has it.
struct ConeRay {
  Vec3 f;           ///< from the axis to the ray's origin
  Vec3 k;           ///< direction x axis, times the cosine: across both
  Vec3 g;           ///< the direction's part across the axis, exactly as k
  double along;     ///< of the origin, from the foot
  double slope;     ///< direction . axis
  double girth;     ///< at the origin
  double widening;  ///< of the girth along the ray
  double a;
  double b;
  double x;      ///< f x g
  double root;   ///< of b^2 - a C; negative where the endless cone is not met
  double reach;  ///< what is rounded is no larger

  double at_disc(double t) const { return length(f + t * g); }
};

ConeRay in_cone(const Ray& ray, const PackedCone& c) {
  const SurfacePoint& from = ray.origin;
  const Vec3 delta = from.anchor - c.foot;
  const double delta_along = dot(delta, c.axis);
  const double offset_along = dot(from.offset, c.axis);
  ConeRay r;
  r.f = c.cosine * ((delta - delta_along * c.axis) + (from.offset - offset_along * c.axis));
  r.k = c.cosine * cross(ray.direction, c.axis);
  r.g = cross(c.axis, r.k);
  r.along = delta_along + offset_along;
  r.slope = dot(ray.direction, c.axis);
  r.girth = c.girth(r.along);
  r.widening = c.sine * r.slope;
  r.a = dot(r.k, r.k) - r.widening * r.widening;
  r.b = 0 - (dot(r.f, r.g) - r.girth * r.widening);  // never -0: the roots are told by its sign
  r.x = dot(r.f, r.k);
  const Vec3 p = r.girth * r.g - r.widening * r.f;
  const double room = dot(p, p) - r.x * r.x;
  r.root = room >= 0 ? std::sqrt(room) : -1;
  r.reach = max_abs(from.anchor) + max_abs(c.foot) + from.radius;
  return r;
}

struct ConeHit {
  double t;
  int part;
  bool is_inside;  ///< the ray meets the back
  Vec3 outward;    ///< unit normal, out of the solid
  double along;    ///< on the side, of the hit along the axis, from the foot
  double radius;   ///< there
  Vec3 aside;      ///< unit, from the axis to the hit
};

/// Normal and place from where the ray is nearest to the axis: F + t G would lose as many digits as
/// the origin is radii away.
ConeHit on_side(const ConeRay& r, const PackedCone& c, double t, double root, bool is_leave) {
  const double girth = std::max(r.girth + t * r.widening, 0.0);
  Vec3 aside = unit(r.x * r.k + (girth * r.widening + (is_leave ? root : -root)) * r.g);
  if (aside == Vec3{}) aside = unit(r.f + t * r.g);
  if (aside == Vec3{}) aside = orthonormal_basis(c.axis).u;
  ConeHit hit{t, side_part, is_leave, c.cosine * aside - c.sine * c.axis, 0, 0, aside};
  if (c.cosine >= std::abs(c.sine)) {
    hit.along = std::clamp(r.along + t * r.slope, c.low, c.high);
    hit.radius = std::max(c.girth(hit.along), 0.0) / c.cosine;
  } else {
    const auto [least, most] = std::minmax(c.radius_from, c.radius_to);
    hit.radius = std::clamp(r.at_disc(t) / c.cosine, least, most);
    hit.along = std::clamp((c.cosine * hit.radius - c.girth_at_foot) / c.sine, c.low, c.high);
  }
  return hit;
}

ConeHit on_cap(const ConeRay& r, const PackedCone& c, double t, bool is_leave) {
  const bool is_to = (r.slope > 0) == is_leave;
  return {t, is_to ? to_part : from_part, is_leave, is_to ? c.axis : -c.axis, 0, 0, {}};
}

/// Where the ray passes the planes of the ends, and whether through their discs.
struct Ends {
  double enter = -infinity;
  double leave = infinity;
  bool enters_disc = false;
  bool leaves_disc = false;
  bool is_between = true;  ///< somewhere

  /// The planes are that far along the axis.
  Ends(const ConeRay& r, const PackedCone& c, double to_low, double to_high) {
    if (r.slope == 0) {
      is_between = to_low <= 0 && to_high >= 0;
      return;
    }
    const bool is_up = r.slope > 0;
    enter = (is_up ? to_low : to_high) / r.slope;
    leave = (is_up ? to_high : to_low) / r.slope;
    // A tip is none.
    enters_disc = r.at_disc(enter) < c.cosine * c.radius(!is_up);
    leaves_disc = r.at_disc(leave) < c.cosine * c.radius(is_up);
  }
};

/// The way through the closed cone.
struct Chord {
  double enter;
  double leave;
};

std::optional<Chord> chord_of(const ConeRay& r, const Ends& ends, double power) {
  const double q = r.b + std::copysign(std::max(r.root, 0.0), r.b);
  const double one = q != 0 ? power / q : 0;
  const double other = r.a != 0 ? q / r.a : std::copysign(infinity, q);
  const bool within_side = r.root >= 0 && r.a > 0 && ends.is_between && r.b >= r.a * ends.enter &&
                           r.b <= r.a * ends.leave;
  if (!ends.enters_disc && !ends.leaves_disc && !within_side) return {};
  const auto [enter, leave] = r.b >= 0 ? std::pair(one, other) : std::pair(other, one);
  return Chord{ends.enters_disc ? ends.enter : std::clamp(enter, ends.enter, ends.leave),
               ends.leaves_disc ? ends.leave : std::clamp(leave, ends.enter, ends.leave)};
}

/// From the inside of the side: to the other side, or to what is at the end.
std::optional<ConeHit> leave_side(const ConeRay& r, const Ray& ray, const PackedCone& c) {
  const SurfacePoint& from = ray.origin;
  const double b = c.cosine * from.radius * dot(from.normal, ray.direction);
  const Ends ends(r, c, std::min(c.low - r.along, 0.0), std::max(c.high - r.along, 0.0));
  const double t = r.a > 0 ? std::max(2 * b / r.a, 0.0) : infinity;
  if (t <= ends.leave) return on_side(r, c, t, b, true);
  if (!c.has_caps || c.radius(r.slope > 0) == 0) return {};
  return on_cap(r, c, std::max(ends.leave, 0.0), true);
}

/// The nearest hit at t > 0.
std::optional<ConeHit> intersect_cone(const Ray& ray, const PackedCone& c) {
  const ConeLeft left = left_surface(ray, c);
  // Convex: what leaves its outside meets nothing of it again, open or closed.
  if (left.is_left && !left.from_inside) return {};
  const SurfacePoint& from = ray.origin;
  const ConeRay r = in_cone(ray, c);
  if (left.is_left && left.part == side_part) return leave_side(r, ray, c);

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
    const double distance = length(r.f);
    const double noise = 8 * rounding_of_doubles * r.reach;
    is_on_side = r.girth >= 0 && std::abs(distance - r.girth) <= noise;
    power = is_on_side ? 0 : (distance - r.girth) * (distance + r.girth);
  }

  const Ends ends(r, c, to_low, to_high);
  const auto chord = chord_of(r, ends, power);
  const auto enters = [&] {
    return ends.enters_disc ? on_cap(r, c, chord->enter, false)
                            : on_side(r, c, chord->enter, std::max(r.root, 0.0), false);
  };
  const auto leaves = [&](double t) {
    return ends.leaves_disc ? on_cap(r, c, t, true) : on_side(r, c, t, std::max(r.root, 0.0), true);
  };
  // From the inside of a cap: it leaves through something.
  if (left.is_left) return leaves(chord ? std::max(chord->leave, 0.0) : 0.0);
  if (!chord) return {};
  if (!c.has_caps) {
    if (!ends.enters_disc && chord->enter > 0) return enters();
    if (!ends.leaves_disc && chord->leave > 0) return leaves(chord->leave);
    return {};
  }
  const bool starts_on_it = is_on_side && chord->enter == 0 && chord->leave > 0;  // and goes in
  if (chord->enter > 0 || starts_on_it) return enters();
  if (!(chord->leave > 0)) return {};
  return leaves(chord->leave);
}

}  // namespace

std::optional<SurfaceHit> intersect(const Ray& ray, const PackedCone& c) {
  const auto hit = intersect_cone(ray, c);
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
