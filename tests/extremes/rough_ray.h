// What a ray surely misses, told in a fiftieth of the time that numbers of 113 bits take.
#pragma once

#include <optional>

#include "engine/engine.h"
#include "tests/extremes/quad.h"

namespace raytracer::extremes {

/// Of 64 bits where the processor has such numbers, and as large as a Quad.
struct RoughVec {
  long double x;
  long double y;
  long double z;

  explicit RoughVec(const QuadVec& v)
      : x(static_cast<long double>(v.x)),
        y(static_cast<long double>(v.y)),
        z(static_cast<long double>(v.z)) {}
  /// From one point to another.
  RoughVec(const Vec3& from, const Vec3& to)
      : x(static_cast<long double>(to.x) - from.x),
        y(static_cast<long double>(to.y) - from.y),
        z(static_cast<long double>(to.z) - from.z) {}
};

inline long double dot(const RoughVec& a, const RoughVec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// A ray from a point relative to the eye, in a unit direction. Its numbers are off by 2^-64 of
/// themselves, and differences by that of what they are made of; all margins are far wider.
class RoughRay {
 public:
  RoughRay(const Vec3& eye, const QuadVec& from, const QuadVec& direction)
      : eye_(eye), from_(from), direction_(direction) {}

  /// Whether it surely stays outside of a sphere.
  bool passes_by(const Vec3& center, long double radius) const {
    constexpr long double margin = 1e-9L;
    constexpr long double margin_of_difference = 1e-12L * margin;
    const RoughVec c(eye_, center);
    const RoughVec f = from_here(c);
    const long double along = dot(f, direction_);
    const long double f2 = dot(f, f);
    const long double r2 = radius * radius;
    const long double nearest2 = along < 0 ? f2 : f2 - along * along;
    return nearest2 - r2 > margin * (f2 + r2) + margin_of_difference * dot(c, c);
  }

  /// Whether a plane is surely behind it, or beyond t = `end`, if there is one.
  bool does_not_reach(const Plane& plane, const std::optional<Quad>& end) const {
    constexpr long double margin = 1e-12L;
    const RoughVec n{QuadVec(plane.normal)};
    const RoughVec c(eye_, plane.point);
    const long double slope = dot(n, direction_);
    const long double height = dot(n, from_here(c));
    const long double n2 = dot(n, n);
    if (slope * slope < margin * margin * n2) return false;
    if (height * height < margin * margin * n2 * (dot(c, c) + dot(from_, from_))) return false;
    const long double t = height / slope;
    constexpr long double margin_of_quotient = 1e-5L;
    return t < 0 || (end && t > static_cast<long double>(*end) * (1 + margin_of_quotient));
  }

 private:
  RoughVec from_here(RoughVec to) const {
    to.x -= from_.x;
    to.y -= from_.y;
    to.z -= from_.z;
    return to;
  }

  const Vec3& eye_;
  RoughVec from_;
  RoughVec direction_;
};

}  // namespace raytracer::extremes
