#include "engine/math/ray_sphere.h"

#include <cmath>

#include "engine/math/compensated.h"

namespace raytracer {
namespace {

/// C = |delta + offset|^2 - r^2 for |offset| = r_left: positive outside, negative inside.
/// Twice r_left's and the offset's squares cancel in the formula, not in the arithmetic.
double power_of_point(const Vec3& delta, const Vec3& offset, double r_left, double r) {
  const double squares = dot(delta, delta);
  const double mixed = 2 * dot(delta, offset);
  const double radii = (r_left - r) * (r_left + r);
  const double uncompensated = squares + mixed + radii;
  constexpr double cancelled = 0x1p-20;
  if (std::abs(uncompensated) > cancelled * (squares + std::abs(radii))) return uncompensated;

  CompensatedSum sum;
  sum.add_product(delta.x, delta.x);
  sum.add_product(delta.y, delta.y);
  sum.add_product(delta.z, delta.z);
  sum.add_product(2 * delta.x, offset.x);
  sum.add_product(2 * delta.y, offset.y);
  sum.add_product(2 * delta.z, offset.z);
  sum.add_product(r_left, r_left);
  sum.add_product(-r, r);
  return sum.total();
}

}  // namespace

std::optional<SphereHit> intersect_sphere(const Ray& ray, const Vec3& center, double radius,
                                          bool is_left) {
  const SurfacePoint& from = ray.origin;
  const Vec3& d = ray.direction;
  if (is_left) {
    if (from.side == SurfacePoint::Side::round_outside) return {};
    const double t = -2 * dot(from.offset, d);
    if (!(t > 0)) return {};
    return SphereHit{t, unit(from.offset + t * d), true};
  }

  const Vec3 delta = from.anchor - center;
  const Vec3 f = delta + from.offset;
  const double b = -dot(f, d);
  const Vec3 perpendicular = f + b * d;
  const double discriminant = radius * radius - dot(perpendicular, perpendicular);
  if (!(discriminant >= 0)) return {};

  const double s = std::sqrt(discriminant);
  const double c = power_of_point(delta, from.offset, from.radius, radius);
  if (c > 0) {
    if (b <= 0) return {};
    return SphereHit{c / (b + s), (perpendicular - s * d) / radius, false};
  }
  const double t = b >= 0 ? b + s : c / (b - s);
  if (!(t > 0)) return {};  // on the surface, looking away
  return SphereHit{t, (perpendicular + s * d) / radius, true};
}

}  // namespace raytracer
