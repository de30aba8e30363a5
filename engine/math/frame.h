// The coordinates that kernels work in: the eye at the origin, the scene's extent near 1.
//
// Scaling is by a power of two, hence exact, and the eye is subtracted before any other
// arithmetic: a scene moved far away or scaled renders like the same scene at home, and squares
// neither overflow nor underflow.
//
// Limits: a sphere or triangle 2^480 times smaller than the extent is left out of the picture, and
// the plan's health says so.
#pragma once

#include <cmath>

#include "engine/math/vec.h"

namespace raytracer {

class Frame {
 public:
  Frame() = default;
  Frame(const Vec3& eye, int exponent)
      : eye_(eye),
        exponent_(exponent),
        first_factor_(std::ldexp(1.0, -exponent / 2)),
        second_factor_(std::ldexp(1.0, -exponent - -exponent / 2)) {}

  /// One unit of the frame is 2^exponent of the scene's.
  int exponent() const { return exponent_; }

  /// In the scene's coordinates.
  const Vec3& eye() const { return eye_; }

  /// The origin of the scene's coordinates, in frame coordinates.
  Vec3 scene_origin() const { return -(eye_ * first_factor_ * second_factor_); }

  /// A point of the scene in frame coordinates; one rounding, of the difference to the eye.
  Vec3 frame_from_scene(const Vec3& point) const {
    const Vec3 difference = point - eye_;
    if (std::isfinite(max_abs(difference))) return difference * first_factor_ * second_factor_;
    // The difference of two doubles may overflow, a quarter of it never.
    return (point * 0.25 - eye_ * 0.25) * first_factor_ * second_factor_ * 4;
  }

  /// Whether squares of a length in frame coordinates, and their products with others, are held.
  static bool carries(double length) { return length >= 0x1p-480; }

  /// A length of the scene in frame coordinates.
  double frame_from_scene(double length) const { return length * first_factor_ * second_factor_; }

 private:
  Vec3 eye_;  ///< in scene coordinates
  int exponent_ = 0;
  // Together 2^-exponent, which may be more than a double holds.
  double first_factor_ = 1;
  double second_factor_ = 1;
};

}  // namespace raytracer
