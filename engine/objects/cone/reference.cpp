// Where a ray meets a cone: the definition, in double and one ray at a time.
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/math/tolerances.h"
#include "engine/objects/axial_reference.h"
#include "engine/objects/cone/cone.h"

namespace raytracer {
namespace {

/// The ray as cone.h has it.
struct ConeRay : AxialRay {
  double girth;     ///< at the origin
  double widening;  ///< of the girth along the ray
  double a;
  double b;
  double root;  ///< of b^2 - a C; negative where the endless cone is not met

  ConeRay(const Ray& ray, const PackedCone& c) : AxialRay(ray, c, c.cosine) {
    girth = c.girth(along);
    widening = c.sine * slope;
    a = dot(k, k) - widening * widening;
    b = 0 - (dot(f, g) - girth * widening);  // never -0: the roots are told by its sign
    const Vec3 p = girth * g - widening * f;
    const double room = dot(p, p) - x * x;
    root = room >= 0 ? std::sqrt(room) : -1;
  }

  double at_disc(double t) const { return length(f + t * g); }
};

/// Rounding where it is less than the place is rounded by.
AxialPower power_at(const ConeRay& r, const PackedCone&, const SurfacePoint&) {
  const double distance = length(r.f);
  const double noise = 8 * unit_roundoff<double> * r.reach;
  if (r.girth >= 0 && std::abs(distance - r.girth) <= noise) return {0, true};
  return {(distance - r.girth) * (distance + r.girth)};
}

/// Normal and place from where the ray is nearest to the axis: F + t G would lose as many digits as
/// the origin is radii away.
AxialHit on_side(const ConeRay& r, const PackedCone& c, double t, double root, bool is_leave) {
  const double girth = std::max(r.girth + t * r.widening, 0.0);
  Vec3 aside = unit(r.x * r.k + (girth * r.widening + (is_leave ? root : -root)) * r.g);
  if (aside == Vec3{}) aside = unit(r.f + t * r.g);
  if (aside == Vec3{}) aside = orthonormal_basis(c.axis).u;
  AxialHit hit{t, side_part, is_leave, c.cosine * aside - c.sine * c.axis, 0, 0, aside};
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
AxialHit on_side(const ConeRay& r, const PackedCone& c, double t, bool is_leave) {
  return on_side(r, c, t, std::max(r.root, 0.0), is_leave);
}

std::optional<AxialChord> chord_of(const ConeRay& r, const PackedCone& c, const EndPlanes& planes,
                                   double power) {
  const bool is_up = r.slope > 0;
  const auto is_in_disc = [&](double t, bool is_to) {  // a tip is none
    return r.slope != 0 && r.at_disc(t) < c.cosine * c.radius(is_to);
  };
  const bool enters_disc = is_in_disc(planes.enter, !is_up);
  const bool leaves_disc = is_in_disc(planes.leave, is_up);
  const bool within_side = r.root >= 0 && r.a > 0 && planes.is_between &&
                           r.b >= r.a * planes.enter && r.b <= r.a * planes.leave;
  if (!enters_disc && !leaves_disc && !within_side) return {};
  const double q = r.b + std::copysign(std::max(r.root, 0.0), r.b);
  const double one = q != 0 ? power / q : 0;
  const double other = r.a != 0 ? q / r.a : std::copysign(infinity, q);
  const auto [enter, leave] = r.b >= 0 ? std::pair(one, other) : std::pair(other, one);
  return AxialChord{enters_disc ? planes.enter : std::clamp(enter, planes.enter, planes.leave),
                    leaves_disc ? planes.leave : std::clamp(leave, planes.enter, planes.leave),
                    enters_disc, leaves_disc};
}

std::optional<AxialHit> leave_side(const ConeRay& r, const Ray& ray, const PackedCone& c) {
  const SurfacePoint& from = ray.origin;
  const double b = c.cosine * from.radius * dot(from.normal, ray.direction);
  const EndPlanes planes = planes_around(r, c);
  const double t = r.a > 0 ? std::max(2 * b / r.a, 0.0) : infinity;
  if (t <= planes.leave) return on_side(r, c, t, b, true);
  if (!c.has_caps || c.radius(r.slope > 0) == 0) return {};
  return on_cap(r, c, std::max(planes.leave, 0.0), true);
}

}  // namespace

std::optional<SurfaceHit> intersect(const Ray& ray, const PackedCone& c) {
  return surface_hit(ray, c, nearest_hit(ConeRay(ray, c), ray, c));
}

}  // namespace raytracer
