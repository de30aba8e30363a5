// Cylinders in frame coordinates, and how far they are from a place.
#include <algorithm>
#include <cmath>

#include "engine/objects/cylinder/cylinder.h"

namespace raytracer {

PackedCylinder packed(const Cylinder& c, const PrimitiveId& id, const Frame& frame) {
  const PlacedAxis axis = place_axis(c.from, c.to, frame);
  const double radius = frame.frame_from_scene(c.radius);
  return {{axis.segment, axis.power_of_eye(radius), c.caps, id}, radius};
}

PackedCylinder seen_from(const PackedCylinder& c, const Vec3& place) {
  PackedCylinder seen = c;
  static_cast<AxisSegment&>(seen) = c.seen_from(place);
  const double distance = length(seen.foot);
  seen.eye_power = AxisSegment::without_noise((distance - c.radius) * (distance + c.radius),
                                              c.radius * c.radius);
  return seen;
}

double distance_to_surface(const PackedCylinder& c, const Vec3& place) {
  const Vec3 from_foot = place - c.foot;
  const double along = dot(from_foot, c.axis);
  const double over_side = length(from_foot - along * c.axis) - c.radius;
  const double over_ends = std::max(c.low - along, along - c.high);
  if (!c.has_caps) return std::hypot(over_side, std::max(over_ends, 0.0));
  if (over_side < 0 && over_ends < 0) return std::max(over_side, over_ends);
  return std::hypot(std::max(over_side, 0.0), std::max(over_ends, 0.0));
}

}  // namespace raytracer
