// Unbounded planes.
//
//   { "type": "plane", "point": [0, -4, 0], "normal": [0, 1, 0] }
//
// Leaving a surface: a ray that leaves a plane to one side cannot meet what lies in the plane or on
// its other side (math/ray_plane.h).
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <tuple>

#include "engine/objects/kind.h"

namespace raytracer {

struct Plane {
  Vec3 point;
  Vec3 normal;  ///< not zero, any length

  static constexpr std::string_view type = "plane";
  static constexpr std::string_view description = "Unbounded.";
  static constexpr auto fields = std::tuple(required("point", &Plane::point, PointRule{}),
                                            required("normal", &Plane::normal, DirectionRule{}));
};

/// In frame coordinates.
struct PackedPlane {
  Vec3 point;
  Vec3 normal;  ///< unit
  PrimitiveId id;
};

struct PlaneKind {
  using Documents = Types<Plane>;
  using Primitive = PackedPlane;

  static constexpr std::string_view noun = "plane";
  static constexpr Search search = Search::unbounded;
  static constexpr bool has_exact_shadows = false;
  static constexpr bool has_light_sweep = false;
  static constexpr double tolerance_px = 1.0 / 64;
};

inline std::size_t item_count(const Plane&) { return 1; }

template <typename Include>
void for_each_extent(const Plane& p, const Include& include) {
  include(p.point, 0);
}

void pack(const Plane& plane, Packing<PackedPlane>& to);

/// Of no thickness, if the plane is across an axis.
Box bounds(const PackedPlane& plane);

void add_statistics(const PackedPlane& plane, const Viewpoint& from, GeometryStatistics& to);

inline void add_mirror(const PackedPlane&, CurvedMirrors&) {}  // it magnifies nothing

/// Whether rounding decides on which side of the plane the light is.
bool is_grazed(const PackedPlane& plane, const PackedLight& light);

/// Its point that is nearest to the eye.
std::optional<Placement> placement_of(const PackedPlane& plane);

std::optional<SurfaceHit> intersect(const Ray& ray, const PackedPlane& plane);

}  // namespace raytracer
