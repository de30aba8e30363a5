// Cones in frame coordinates, and how far they are from a place.
#include <algorithm>
#include <cmath>

#include "engine/math/tolerances.h"
#include "engine/objects/cone/cone.h"

namespace raytracer {
namespace {

/// The eye's C; 0 on the side, as near as rounding tells.
double power_of_eye(const PackedCone& c) {
  const double distance = c.cosine * length(c.foot);
  const double girth = std::abs(c.girth_at_foot);
  const double reach = distance + girth + std::abs(c.sine * c.low);
  if (std::abs(distance - girth) <= 4 * unit_roundoff<double> * reach) return 0;
  return (distance - girth) * (distance + girth);
}

/// A place in a plane through the axis.
struct ProfilePoint {
  double across;
  double along;
};

double distance_to_line(const ProfilePoint& p, const ProfilePoint& a, const ProfilePoint& b) {
  const double across = b.across - a.across;
  const double along = b.along - a.along;
  const double size = std::hypot(across, along);
  if (!(size > 0)) return std::hypot(p.across - a.across, p.along - a.along);
  const double place =
      ((p.across - a.across) * (across / size) + (p.along - a.along) * (along / size)) / size;
  const double share = std::clamp(place, 0.0, 1.0);
  return std::hypot(p.across - (a.across + share * across), p.along - (a.along + share * along));
}

}  // namespace

PackedCone packed(const Cone& c, const PrimitiveId& id, const Frame& frame) {
  PackedCone packed{{place_axis(c.from, c.to, frame).segment, 0, c.caps, id},
                    frame.frame_from_scene(c.radius_from),
                    frame.frame_from_scene(c.radius_to),
                    0,
                    0,
                    0};
  const double rise = packed.high - packed.low;
  const double widening = packed.radius_to - packed.radius_from;
  const double slant = std::hypot(rise, widening);
  if (!(slant > 0)) return packed;
  packed.cosine = rise / slant;
  packed.sine = widening / slant;
  packed.girth_at_foot = packed.cosine * packed.radius_from - packed.sine * packed.low;
  packed.eye_power = power_of_eye(packed);
  return packed;
}

PackedCone seen_from(const PackedCone& c, const Vec3& place) {
  PackedCone seen = c;
  static_cast<AxisSegment&>(seen) = c.seen_from(place);
  seen.girth_at_foot = c.girth(dot(place - c.foot, c.axis));
  const double distance = c.cosine * length(seen.foot);
  seen.eye_power = AxisSegment::without_noise(
      (distance - seen.girth_at_foot) * (distance + seen.girth_at_foot), distance * distance);
  return seen;
}

double distance_to_surface(const PackedCone& c, const Vec3& place) {
  const Vec3 from_foot = place - c.foot;
  const double along = dot(from_foot, c.axis);
  const ProfilePoint p{length(from_foot - along * c.axis), along};
  const double to_side = distance_to_line(p, {c.radius_from, c.low}, {c.radius_to, c.high});
  if (!c.has_caps) return to_side;
  const double over_side = c.cosine * p.across - c.girth(along);
  const double over_ends = std::max(c.low - along, along - c.high);
  if (over_side < 0 && over_ends < 0) return std::max(over_side, over_ends);
  const double to_low = distance_to_line(p, {0, c.low}, {c.radius_from, c.low});
  const double to_high = distance_to_line(p, {0, c.high}, {c.radius_to, c.high});
  return std::min({to_side, to_low, to_high});
}

}  // namespace raytracer
