// Three doubles: a point, a direction or a linear colour, with the usual infix operators.
//
// Everything is constexpr or inline and rounds each operation once (the build forbids fused
// contraction), so that the same expression gives the same bits on every machine.
#pragma once

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>

namespace raytracer {

/// Beyond every distance.
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// A point, or a displacement; a unit vector where the name says so.
struct Vec3 {
  double x = 0;
  double y = 0;
  double z = 0;

  friend constexpr auto operator<=>(const Vec3&, const Vec3&) = default;

  constexpr Vec3& operator+=(const Vec3& b) { return *this = {x + b.x, y + b.y, z + b.z}; }
};

/// A colour, linear: x, y and z hold red, green and blue.
using Rgb = Vec3;

constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
constexpr Vec3 operator*(const Vec3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr Vec3 operator*(double s, const Vec3& a) { return a * s; }
constexpr Vec3 operator/(const Vec3& a, double s) { return {a.x / s, a.y / s, a.z / s}; }

constexpr double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Antisymmetric to the bit: cross(a, b) == -cross(b, a).
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The coordinate along axis 0, 1 or 2.
constexpr double component(const Vec3& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
constexpr double& component(Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// The largest coordinate by magnitude.
inline double max_abs(const Vec3& a) {
  return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
}

/// Euclidean length; squares that leave the range of doubles make it 0 or infinite.
inline double length(const Vec3& a) { return std::sqrt(dot(a, a)); }

/// a times 2^exponent: exact unless the result is subnormal or overflows.
inline Vec3 scaled(const Vec3& a, int exponent) {
  return {std::ldexp(a.x, exponent), std::ldexp(a.y, exponent), std::ldexp(a.z, exponent)};
}

/// The direction of `a`, which may have any finite length but 0 (the zero vector stays zero).
inline Vec3 unit(const Vec3& a) {
  const double square = dot(a, a);
  if (square > 0x1p-900 && square < 0x1p900) return a / std::sqrt(square);
  const double largest = max_abs(a);
  if (largest == 0) return a;
  const Vec3 near_one = scaled(a, -std::ilogb(largest));  // so that no square leaves the range
  return near_one / length(near_one);
}

/// `direction` mirrored in the plane across the unit vector `normal`.
constexpr Vec3 reflected(const Vec3& direction, const Vec3& normal) {
  return direction - 2 * dot(direction, normal) * normal;
}

/// Two directions across a third, all unit and at right angles to each other.
struct OrthonormalBasis {
  Vec3 u;
  Vec3 v;
};

/// Directions across the unit vector w, with (u, v, w) right-handed (Duff et al.: "Building an
/// Orthonormal Basis, Revisited", JCGT 2017).
inline OrthonormalBasis orthonormal_basis(const Vec3& w) {
  const double sign = std::copysign(1.0, w.z);
  const double a = -1 / (sign + w.z);
  const double b = w.x * w.y * a;
  return {{1 + sign * w.x * w.x * a, sign * b, -sign * w.x}, {b, sign + w.y * w.y * a, -w.y}};
}

}  // namespace raytracer
