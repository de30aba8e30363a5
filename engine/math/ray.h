// Rays that remember the surface they leave, so that no epsilon is needed to leave it.
//
// A point on a round surface is kept as anchor + offset, the anchor being a sphere's centre:
// differences of centres are then rounded once, however far the sphere is from the coordinates'
// origin, and a convex surface is known not to hit itself (see "Leaving a surface" in each folder
// of engine/objects).
#pragma once

#include <compare>
#include <cstdint>

#include "engine/math/vec.h"

namespace raytracer {

/// Where rays branch, those that count for less are left out. Given by the scene format.
inline constexpr double least_ray_weight = 0x1p-14;

/// What was hit: an object of the document and which of its primitives (a sphere of a set, a
/// triangle of a mesh, else 0). The order is the document's, which decides between equal distances.
struct PrimitiveId {
  std::uint32_t object = 0;
  std::uint64_t item = 0;

  friend auto operator<=>(const PrimitiveId&, const PrimitiveId&) = default;
};

/// Where a ray begins: the eye, or a point on a surface seen from one side.
struct SurfacePoint {
  enum class Side { none, round_outside, round_inside, flat };

  Side side = Side::none;
  PrimitiveId id;  ///< of the surface, if there is one
  int part = 0;    ///< which of the primitive's surfaces, as its kind counts them
  /// Seen from the inside; of what is flat, from the side that its own normal does not point to.
  bool is_inside = false;
  bool has_inside = true;  ///< what is open has none: rays that pass it are not bent
  Vec3 weights;            ///< of something between corners: how much each of them counts, 1 in sum
  Vec3 anchor;        ///< of a round surface the point `radius` below it; else the point itself
  Vec3 offset;        ///< from the anchor to the point: zero but for round surfaces
  double radius = 0;  ///< of a round surface: the offset's length
  Vec3 normal;        ///< unit, towards the side that the ray leaves to
  Vec3 flat_point;    ///< flat: an exact point of the plane (`anchor` is a rounded one)

  Vec3 point() const { return anchor + offset; }
  bool is_on_surface(const PrimitiveId& other) const { return side != Side::none && id == other; }
};

/// The same point, left to its other side.
inline SurfacePoint other_side(SurfacePoint point) {
  using Side = SurfacePoint::Side;
  if (point.side == Side::round_outside)
    point.side = Side::round_inside;
  else if (point.side == Side::round_inside)
    point.side = Side::round_outside;
  point.normal = -point.normal;
  point.is_inside = !point.is_inside;
  return point;
}

struct Ray {
  SurfacePoint origin;
  Vec3 direction;  ///< unit
};

/// Where a ray meets a surface, seen from the side that it comes from.
struct SurfaceHit {
  double t;
  SurfacePoint point;
};

/// The point of a sphere's surface, or of a surface as round, in direction `outward` (of any
/// length) from `center`.
inline SurfacePoint round_point(const PrimitiveId& id, const Vec3& center, double radius,
                                const Vec3& outward, bool is_inside) {
  const Vec3 normal = unit(outward);
  return {.side = is_inside ? SurfacePoint::Side::round_inside : SurfacePoint::Side::round_outside,
          .id = id,
          .part = 0,
          .is_inside = is_inside,
          .has_inside = true,
          .weights = {},
          .anchor = center,
          .offset = normal * radius,
          .radius = radius,
          .normal = is_inside ? -normal : normal,
          .flat_point = {}};
}

/// The point at distance t along the ray, of a plane through `plane_point` across `normal`, which
/// is turned towards the ray's origin.
inline SurfacePoint flat_point(const PrimitiveId& id, const Ray& ray, double t,
                               const Vec3& plane_point, const Vec3& normal) {
  return {.side = SurfacePoint::Side::flat,
          .id = id,
          .part = 0,
          .is_inside = false,
          .has_inside = true,
          .weights = {},
          .anchor = ray.origin.anchor + (ray.origin.offset + t * ray.direction),
          .offset = {},
          .radius = 0,
          .normal = normal,
          .flat_point = plane_point};
}

}  // namespace raytracer
