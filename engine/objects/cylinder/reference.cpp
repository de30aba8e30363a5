// Where a ray meets a cylinder: the definition, in double and one ray at a time.
#include <algorithm>
#include <cmath>

#include "engine/math/tolerances.h"
#include "engine/objects/axial_reference.h"
#include "engine/objects/cylinder/cylinder.h"

namespace raytracer {
namespace {

struct CylinderRay : AxialRay {
  double a;  ///< |g|^2 = |k|^2; x is its root times the distance of the two lines
  double b;  ///< -f.g: a times the distance along the ray to where it is nearest to the axis

  CylinderRay(const Ray& ray, const PackedCylinder& c) : AxialRay(ray, c) {
    a = dot(k, k);
    b = 0 - dot(f, g);  // never -0: the roots are told apart by its sign
  }
};

/// |f|^2 - r^2, which is rounding where it is less than the place is rounded by.
AxialPower power_at(const CylinderRay& r, const PackedCylinder& c, const SurfacePoint& from) {
  const double power = dot(r.f, r.f) - c.radius * c.radius;
  if (std::abs(power) <= 8 * unit_roundoff<double> * r.reach * c.radius) return {0, true};
  // What leaves its own cap starts inside.
  return {from.is_on_surface(c.id) ? std::min(power, 0.0) : power};
}

/// From where to where along the ray: empty unless enter <= leave.
struct Span {
  double enter = infinity;
  double leave = -infinity;
};

/// Where the ray is within the endless cylinder.
Span within_side(const CylinderRay& r, double radius, double power) {
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

std::optional<AxialChord> chord_of(const CylinderRay& r, const PackedCylinder& c,
                                   const EndPlanes& planes, double power) {
  const Span side = within_side(r, c.radius, power);
  const double enter = std::max(side.enter, planes.enter);
  const double leave = std::min(side.leave, planes.leave);
  if (!planes.is_between || !(enter <= leave)) return {};
  const bool enters_cap = planes.enter > side.enter;
  const bool leaves_cap = planes.leave < side.leave;
  return AxialChord{enter, leave, enters_cap, leaves_cap};
}

AxialHit on_side(const CylinderRay& r, const PackedCylinder& c, double t, const Vec3& outward,
                 bool is_leave) {
  const double along = std::clamp(r.along + t * r.slope, c.low, c.high);
  return {t, side_part, is_leave, outward, along, c.radius, outward};
}

/// The normal from where the ray is nearest to the axis, (x / a) k from it: f + t g would lose as
/// many digits as the origin is radii away.
AxialHit on_side(const CylinderRay& r, const PackedCylinder& c, double t, bool is_leave) {
  const double s = std::sqrt(std::max(c.radius * c.radius * r.a - r.x * r.x, 0.0));
  return on_side(r, c, t, unit(r.x * r.k + (is_leave ? s : -s) * r.g), is_leave);
}

std::optional<AxialHit> leave_side(const CylinderRay& r, const Ray& ray, const PackedCylinder& c) {
  const Vec3& offset = ray.origin.offset;
  const double b = -dot(offset, r.g);
  const EndPlanes planes = planes_around(r, c);
  const double t = r.a > 0 ? std::max(2 * b / r.a, 0.0) : infinity;
  if (t <= planes.leave) return on_side(r, c, t, unit(offset + t * r.g), true);
  if (!c.has_caps) return {};
  return on_cap(r, c, std::max(planes.leave, 0.0), true);
}

}  // namespace

std::optional<SurfaceHit> intersect(const Ray& ray, const PackedCylinder& c) {
  return surface_hit(ray, c, nearest_hit(CylinderRay(ray, c), ray, c));
}

}  // namespace raytracer
