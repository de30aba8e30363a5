// Spheres: one, or many of one material.
//
//   { "type": "sphere", "center": [0, 0, 0], "radius": 2, "material": "red" }
//   { "type": "spheres", "centers": [[0, 0, 0], [1, 0, 0]], "radius": [0.1, 0.2] }
//
// The arithmetic is in math/ray_sphere.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "engine/objects/kind.h"

namespace raytracer {

struct Sphere {
  Vec3 center;
  double radius = 0;

  static constexpr std::string_view type = "sphere";
  static constexpr std::string_view description = "A sphere.";
  static constexpr auto fields =
      std::tuple(required("center", &Sphere::center, PointRule{}),
                 required("radius", &Sphere::radius, NumberRule{positive}));
};

/// In order.
struct Spheres {
  std::vector<Vec3> centers;
  std::vector<double> radii;  ///< one for all, or one for each centre
  std::vector<Rgb> colors;    ///< none, or one for each centre, in place of the material's

  double radius(std::size_t i) const { return radii.size() == 1 ? radii[0] : radii[i]; }

  static constexpr std::string_view type = "spheres";
  static constexpr std::string_view description = "Many spheres of one material.";
  static constexpr auto fields =
      std::tuple(required("centers", &Spheres::centers, PointsRule{}),
                 required("radius", &Spheres::radii, NumberPerItemRule{positive, "centers"}),
                 optional("colors", &Spheres::colors, ColorPerItemRule{"centers"}));
};

/// In frame coordinates.
struct PackedSphere {
  Vec3 center;
  double radius;
  PrimitiveId id;
};

struct SphereKind {
  using Documents = Types<Sphere, Spheres>;
  using Primitive = PackedSphere;

  static constexpr std::string_view noun = "sphere";
  static constexpr Search search = Search::bounded;
  // Random spheres under two lights, packets of 16: trying each sphere against a grid for each
  // light 0.45 ms to 0.46 with 24 spheres, 0.51 to 0.49 with 32, 0.76 to 0.60 with 64. The same as
  // mirrors: trying each against a tree 3.18 ms to 3.31 with 128 spheres.
  static constexpr FewPrimitives few{.to_lights = 28, .followed = 128};
  static constexpr double pixels_for_cells = 0;
  static constexpr bool has_exact_shadows = false;
  static constexpr bool has_light_sweep = true;
  /// What rounding may displace its edges by, in pixels.
  static constexpr double tolerance_px = 1.0 / 64;
};

inline std::size_t item_count(const Sphere&) { return 1; }
inline std::size_t item_count(const Spheres& s) { return s.centers.size(); }

template <typename Include>
void for_each_extent(const Sphere& s, const Include& include) {
  include(s.center, s.radius);
}
template <typename Include>
void for_each_extent(const Spheres& s, const Include& include) {
  for (std::size_t i = 0; i < s.centers.size(); ++i) include(s.centers[i], s.radius(i));
}

void pack(const Sphere& sphere, Packing<PackedSphere>& to);
void pack(const Spheres& spheres, Packing<PackedSphere>& to);

inline PackedSphere seen_from(const PackedSphere& s, const Vec3& place) {
  return {s.center - place, s.radius, s.id};
}

inline Box bounds(const PackedSphere& s) {
  const Vec3 r{s.radius, s.radius, s.radius};
  return {s.center - r, s.center + r};
}

/// Where the image may show it; `projection` is that of a view from the origin.
inline PixelRectangle footprint(const Projection& projection, const PackedSphere& s) {
  return projection.of_sphere(s.center, s.radius);
}

/// Calls visit(rectangle, share) with what of the image it may cover, and the share that it does,
/// if that is smaller than a pixel.
template <typename Visit>
void for_each_subpixel_piece(const PackedSphere& s, const Projection& projection,
                             const Visit& visit) {
  if (dot(s.center, s.center) <= s.radius * s.radius) return;
  const PixelRectangle seen = footprint(projection, s);
  const double width = seen.x_end - seen.x_begin;
  const double height = seen.y_end - seen.y_begin;
  if (width > 0 && height > 0 && width * height < 1) visit(seen, std::numbers::pi / 4);
}

/// Whether the eye, at the origin, is nearer to its surface than it is wide: where rays start near
/// the eye, as they do on a ground, differences from the middle would lose their digits.
inline bool is_wide(const PackedSphere& s) {
  return dot(s.center, s.center) < 4 * s.radius * s.radius;
}

/// How near to the origin the edge of its shadow can fall: behind the circle that the light's last
/// rays touch, along which they go on. 0 if the light is inside of it.
double shadow_edge_distance(const PackedSphere& sphere, const PackedLight& light);

/// From the origin to the surface, from outside of it.
inline double nearest_distance(const PackedSphere& s) { return length(s.center) - s.radius; }

/// The tangent of half the angle at which a sphere is seen whose centre is at `distance`; up to a
/// ten thousandth too large. `sine` is radius / distance.
inline double tangent_seen(double distance, double radius, double sine) {
  const double sine2 = sine * sine;
  // The series of sine / sqrt(1 - sine2), its third term enlarged by more than the rest is.
  constexpr double small = 0.05;
  if (sine2 < small) return sine * (1 + sine2 * (0.5 + sine2 * 0.4));
  const double tangent2 = (distance - radius) * (distance + radius);
  return tangent2 > 0 ? radius / std::sqrt(tangent2) : 1e300;
}

// Inline: there may be hundreds of thousands.
inline void add_statistics(const PackedSphere& s, const Viewpoint& from, GeometryStatistics& to) {
  const double distance = length(s.center - from.place);
  const double sine = s.radius / distance;
  to.note_surface(distance - s.radius);
  to.note_place(s.center - from.scene_origin, s.radius);
  // Of one that is_wide() the place is computed from less than twice how far its surface is.
  to.note_meeting(distance < 2 * s.radius ? 2 * std::abs(distance - s.radius)
                                          : distance + s.radius);
  to.farthest = std::max(to.farthest, distance + s.radius);
  to.smallest = std::min(to.smallest, s.radius);
  to.least_sine = std::min(to.least_sine, sine);
  if (2 * s.radius < distance * from.pixel_angle) to.subpixel += 1;
  to.note_blocks(from.blocks(tangent_seen(distance, s.radius, sine)), distance - s.radius);
}

inline void add_mirror(const PackedSphere& s, CurvedMirrors& mirrors) {
  mirrors.include(s.center, s.radius, 1, s.radius);
}

inline std::optional<Placement> placement_of(const PackedSphere& s) {
  return Placement{s.center, {}, s.radius, length(s.center) + s.radius};
}

std::optional<SurfaceHit> intersect(const Ray& ray, const PackedSphere& sphere);

}  // namespace raytracer
