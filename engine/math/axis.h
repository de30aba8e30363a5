// The axis that something round is around, from one end to the other.
//
// Everything is measured from the foot, the point of the axis' line that is nearest to the eye: no
// point of the line is nearer to the eye than it is, so that what it is rounded by is less than
// what the place of any hit is, however long the axis.
#pragma once

#include "engine/math/box.h"
#include "engine/math/compensated.h"
#include "engine/math/frame.h"
#include "engine/math/vec.h"

namespace raytracer {

/// In frame coordinates.
struct AxisSegment {
  Vec3 foot;    ///< the point of the axis' line nearest to the eye
  Vec3 axis;    ///< unit, from `from` to `to`
  double low;   ///< of `from` along the axis, from the foot
  double high;  ///< of `to`

  Vec3 end(bool is_to) const { return foot + (is_to ? high : low) * axis; }

  /// The same relative to `place`, as an eye there has it, but rounded: if that lies in the plane
  /// of an end, the end is exactly at the foot.
  AxisSegment seen_from(const Vec3& place) const;
  /// A difference of two values of that size; 0 where it may be their rounding alone.
  static double without_noise(double difference, double size);
};

/// The same as it was computed, and what doubles leave of the foot.
struct PlacedAxis {
  AxisSegment segment;
  Vec3 foot_rest;

  /// |foot|^2 - radius^2, in twice the precision.
  double power_of_eye(double radius) const;
};

/// Between two points of the scene. One too short for the frame has no extent.
PlacedAxis place_axis(const Vec3& from, const Vec3& to, const Frame& frame);

/// Axes of its own. The axis is turned so that the eye, if it is beyond an end, is beyond the low
/// one.
struct AxisBasis {
  Vec3 across;   ///< unit, at right angles to the other two
  Vec3 towards;  ///< unit, from the eye to the foot
  Vec3 axis;     ///< unit
  bool is_turned;

  explicit AxisBasis(const AxisSegment& segment);
};

/// How far a disc of radius 1 across the unit vector `axis` reaches from its center, either way.
Vec3 reach_of_disc(const Vec3& axis);

}  // namespace raytracer
