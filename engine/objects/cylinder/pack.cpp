// Cylinders in frame coordinates, and what the plan has to know of them: how near, far and
// large they are.
#include <algorithm>
#include <cmath>

#include "engine/objects/cylinder/cylinder.h"

namespace raytracer {
namespace {

bool is_too_small(const PackedCylinder& c) {
  return !Frame::carries(c.radius) || !Frame::carries(c.high - c.low);
}

PackedCylinder pack_one(const Vec3& from, const Vec3& to, double radius, bool caps,
                        const PrimitiveId& id, const Frame& frame) {
  const PlacedAxis axis = place_axis(from, to, frame);
  const double r = frame.frame_from_scene(radius);
  return {axis.segment, r, axis.power_of_eye(r), caps, id};
}

/// How far a place is from the endless cylinder's side and from the ends, negative within.
struct Distances {
  double side;
  double ends;

  Distances(const PackedCylinder& c, const Vec3& place) {
    const Vec3 from_foot = place - c.foot;
    const double along = dot(from_foot, c.axis);
    side = length(from_foot - along * c.axis) - c.radius;
    ends = std::max(c.low - along, along - c.high);
  }

  /// To the surface; negative inside a closed cylinder.
  double to_surface(bool has_caps) const {
    if (!has_caps) return std::hypot(side, std::max(ends, 0.0));
    if (side < 0 && ends < 0) return std::max(side, ends);
    return std::hypot(std::max(side, 0.0), std::max(ends, 0.0));
  }
};

}  // namespace

void pack(const Cylinder& c, Packing<PackedCylinder>& to) {
  const PackedCylinder packed = pack_one(c.from, c.to, c.radius, c.caps, {to.object, 0}, to.frame);
  to.add(packed, !is_too_small(packed));
}

void pack(const Cylinders& c, Packing<PackedCylinder>& to) {
  const auto make = [&](std::size_t i) {
    return pack_one(c.from[i], c.to[i], c.radius(i), c.caps, {to.object, i}, to.frame);
  };
  to.add_all(c.from.size(), make, is_too_small, is_too_small);
}

PackedCylinder seen_from(const PackedCylinder& c, const Vec3& place) {
  PackedCylinder seen = c;
  static_cast<AxisSegment&>(seen) = c.seen_from(place);
  const double distance = length(seen.foot);
  seen.eye_c = AxisSegment::without_noise((distance - c.radius) * (distance + c.radius),
                                          c.radius * c.radius);
  return seen;
}

Box bounds(const PackedCylinder& c) {
  Box box;
  for (const bool is_to : {false, true})
    box.include(box_around_disc(c.end(is_to), c.axis, c.radius));
  return box;
}

double nearest_distance(const PackedCylinder& c) { return Distances(c, {}).to_surface(c.has_caps); }

void add_statistics(const PackedCylinder& c, const Viewpoint& from, GeometryStatistics& to) {
  const Vec3 middle = 0.5 * (c.end(false) + c.end(true)) - from.place;
  double farthest = 0;
  for (const bool is_to : {false, true}) {
    farthest = std::max(farthest, length(c.end(is_to) - from.place));
    to.note_place(c.end(is_to) - from.scene_origin, c.radius);
  }
  double distance = Distances(c, from.place).to_surface(c.has_caps);
  if (from.place == Vec3{} && c.eye_c == 0 && c.low < 0 && c.high > 0) distance = 0;
  to.note_surface(distance);
  to.farthest = std::max(to.farthest, farthest + c.radius);
  to.smallest = std::min(to.smallest, c.radius);
  to.least_sine = std::min(to.least_sine, c.radius / farthest);
  if (2 * c.radius < farthest * from.pixel_angle) to.subpixel += 1;
  const double reach = 0.5 * (c.high - c.low) + c.radius;
  const double in_front = length(middle) - reach;
  to.blocks += from.blocks(in_front > 0 ? reach / in_front : 1e300);
}

}  // namespace raytracer
