// Cones in frame coordinates, and what the plan has to know of them: how near, far and large they
// are.
#include <algorithm>
#include <cmath>

#include "engine/objects/cone/cone.h"

namespace raytracer {
namespace {

bool is_too_small(const PackedCone& c) {
  return !Frame::carries(c.high - c.low) || !Frame::carries(c.cosine * c.largest_radius());
}

/// As PackedCone::eye_c has it; 0 on the side, as near as rounding tells.
double power_of_eye(const PackedCone& c) {
  const double distance = c.cosine * length(c.foot);
  const double girth = std::abs(c.girth_at_foot);
  const double reach = distance + girth + std::abs(c.sine * c.low);
  if (std::abs(distance - girth) <= 4 * rounding_of_doubles * reach) return 0;
  return (distance - girth) * (distance + girth);
}

PackedCone pack_one(const Cone& c, const PrimitiveId& id, const Frame& frame) {
  PackedCone packed{place_axis(c.from, c.to, frame).segment,
                    frame.frame_from_scene(c.radius_from),
                    frame.frame_from_scene(c.radius_to),
                    0,
                    0,
                    0,
                    0,
                    c.caps,
                    id};
  const double rise = packed.high - packed.low;
  const double widening = packed.radius_to - packed.radius_from;
  const double slant = std::hypot(rise, widening);
  if (!(slant > 0)) return packed;
  packed.cosine = rise / slant;
  packed.sine = widening / slant;
  packed.girth_at_foot = packed.cosine * packed.radius_from - packed.sine * packed.low;
  packed.eye_c = power_of_eye(packed);
  return packed;
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

/// How far a place is from the surface; negative inside a closed cone.
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

}  // namespace

void pack(const Cone& c, Packing<PackedCone>& to) {
  const PackedCone packed = pack_one(c, {to.object, 0}, to.frame);
  to.add(packed, !is_too_small(packed));
}

void pack(const Cones& c, Packing<PackedCone>& to) {
  const auto make = [&](std::size_t i) {
    const Cone one{c.from[i], c.to[i], c.radius_from(i), c.radius_to(i), c.caps};
    return pack_one(one, {to.object, i}, to.frame);
  };
  to.add_all(c.from.size(), make, is_too_small, is_too_small);
}

PackedCone seen_from(const PackedCone& c, const Vec3& place) {
  PackedCone seen = c;
  static_cast<AxisSegment&>(seen) = c.seen_from(place);
  seen.girth_at_foot = c.girth(dot(place - c.foot, c.axis));
  const double distance = c.cosine * length(seen.foot);
  seen.eye_c = AxisSegment::without_noise(
      (distance - seen.girth_at_foot) * (distance + seen.girth_at_foot), distance * distance);
  return seen;
}

Box bounds(const PackedCone& c) {
  Box box;
  for (const bool is_to : {false, true})
    box.include(box_around_disc(c.end(is_to), c.axis, c.radius(is_to)));
  return box;
}

double nearest_distance(const PackedCone& c) { return distance_to_surface(c, {}); }

void add_statistics(const PackedCone& c, const Viewpoint& from, GeometryStatistics& to) {
  const double radius = c.largest_radius();
  double farthest = 0;
  for (const bool is_to : {false, true}) {
    farthest = std::max(farthest, length(c.end(is_to) - from.place));
    to.note_place(c.end(is_to) - from.scene_origin, radius);
  }
  double distance = distance_to_surface(c, from.place);
  if (from.place == Vec3{} && c.eye_c == 0 && c.low < 0 && c.high > 0) distance = 0;
  to.note_surface(distance);
  to.farthest = std::max(to.farthest, farthest + radius);
  // Single holds the squares of girths.
  to.smallest = std::min(to.smallest, c.cosine * radius);
  // Of a tip what is thinner than an eighth of a pixel is not looked at.
  const double thinnest = std::min(radius, farthest * from.pixel_angle / 8);
  const double least = std::max(std::min(c.radius_from, c.radius_to), thinnest);
  to.least_sine = std::min(to.least_sine, least / farthest);
  if (c.radius_from + c.radius_to < farthest * from.pixel_angle) to.subpixel += 1;
  const Vec3 middle = 0.5 * (c.end(false) + c.end(true)) - from.place;
  const double reach = 0.5 * (c.high - c.low) + radius;
  const double in_front = length(middle) - reach;
  to.blocks += from.blocks(in_front > 0 ? reach / in_front : 1e300);
}

}  // namespace raytracer
