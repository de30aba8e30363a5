// Where a ray meets a surface of revolution between the ends of its axis: what the definition, in
// double and one ray at a time, has in common for all sides.
//
// A kind brings a structure for its ray, which begins with AxialRay, and for that
//
//   power_at(r, c, from)            of where it begins: what is positive outside the endless side
//   chord_of(r, c, planes, power)   the way through the closed solid
//   on_side(r, c, t, is_leave)      a hit of the side
//   leave_side(r, ray, c)           from the inside of the side, to what is met there
#pragma once

#include <algorithm>
#include <optional>

#include "engine/objects/axial.h"

namespace raytracer {

/// The surfaces, as SurfacePoint::part has them.
enum AxialPart : int { side_part, from_part, to_part };  // the caps at `from` and at `to`

/// How the ray leaves this very solid, if it does.
struct AxialLeft {
  bool is_left = false;
  int part = side_part;
  bool from_inside = false;
};

AxialLeft left_surface(const Ray& ray, const AxialSolid& c);

/// The ray seen along the axis: what is across it, of which the kind may measure a share, and what
/// is along it.
struct AxialRay {
  Vec3 f;        ///< from the axis to the ray's origin, across the axis
  Vec3 k;        ///< direction x axis: across both
  Vec3 g;        ///< the direction's part across the axis, exactly as k
  double x;      ///< f x g
  double along;  ///< of the origin, from the foot
  double slope;  ///< direction . axis
  double reach;  ///< what is rounded is no larger

  AxialRay(const Ray& ray, const AxialSolid& c, double share = 1);
};

/// Where the ray passes the planes of the ends.
struct EndPlanes {
  double enter = -infinity;
  double leave = infinity;
  bool is_between = true;  ///< somewhere

  /// The planes are that far along the axis.
  EndPlanes(double to_low, double to_high, double slope);
};

/// From the inside of the side, however that is rounded.
EndPlanes planes_around(const AxialRay& r, const AxialSolid& c);
/// Of a ray that does not leave the side.
EndPlanes planes_before(const AxialRay& r, const Ray& ray, const AxialSolid& c,
                        const AxialLeft& left);

/// The way through the closed solid.
struct AxialChord {
  double enter;
  double leave;
  bool enters_cap;  ///< else the side
  bool leaves_cap;
};

/// What is positive outside the endless side, and whether the origin is as near to it as rounding
/// tells: then it is 0.
struct AxialPower {
  double value;
  bool is_on_side = false;
};

struct AxialHit {
  double t;
  int part;
  bool is_inside;     ///< the ray meets the back
  Vec3 outward;       ///< unit normal, out of the solid
  double along = 0;   ///< on the side, of the hit along the axis, from the foot
  double radius = 0;  ///< there
  Vec3 aside = {};    ///< unit, from the axis to the hit
};

AxialHit on_cap(const AxialRay& r, const AxialSolid& c, double t, bool is_leave);

/// Nothing unless t > 0.
std::optional<SurfaceHit> surface_hit(const Ray& ray, const AxialSolid& c,
                                      const std::optional<AxialHit>& hit);

/// The nearest hit.
template <class KindRay, AxialPrimitive Solid>
std::optional<AxialHit> nearest_hit(const KindRay& r, const Ray& ray, const Solid& c) {
  const AxialLeft left = left_surface(ray, c);
  // Convex: what leaves its outside meets nothing of it again, open or closed.
  if (left.is_left && !left.from_inside) return {};
  if (left.is_left && left.part == side_part) return leave_side(r, ray, c);

  // Of the eye it is known.
  const bool is_eye = ray.origin.side == SurfacePoint::Side::none;
  const AxialPower power = is_eye ? AxialPower{c.eye_power} : power_at(r, c, ray.origin);
  const auto chord = chord_of(r, c, planes_before(r, ray, c, left), power.value);
  const auto enters = [&] {
    return chord->enters_cap ? on_cap(r, c, chord->enter, false)
                             : on_side(r, c, chord->enter, false);
  };
  const auto leaves = [&](double t) {
    return chord->leaves_cap ? on_cap(r, c, t, true) : on_side(r, c, t, true);
  };
  if (!chord) return {};
  // From the inside of a cap: it leaves through something.
  if (left.is_left) return leaves(std::max(chord->leave, 0.0));
  if (!c.has_caps) {
    if (!chord->enters_cap && chord->enter > 0) return enters();
    if (!chord->leaves_cap && chord->leave > 0) return leaves(chord->leave);
    return {};
  }
  const bool starts_on_it = power.is_on_side && chord->enter == 0 && chord->leave > 0;  // goes in
  if (chord->enter > 0 || starts_on_it) return enters();
  if (!(chord->leave > 0)) return {};
  return leaves(chord->leave);
}

}  // namespace raytracer
