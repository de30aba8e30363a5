// Cylinders: one, or many of one material; with caps closed by a disc at each end, without them
// open.
//
//   { "type": "cylinder", "from": [0, 0, 0], "to": [0, 3, 0], "radius": 0.5, "caps": true }
//   { "type": "cylinders", "from": [[0, 0, 0], [1, 0, 0]], "to": [[0, 1, 0], [1, 2, 0]],
//     "radius": 0.1, "colors": ["#ff0000", "#00ff00"] }
//
// Everything is measured from the foot of its axis (math/axis.h). A ray meets the endless cylinder
// in the plane across the axis, in the residual form that spheres have (math/ray_sphere.h): with f
// from the foot and e the direction's part across the axis, x = f x e and b = -f.e do not cancel,
// nor do the roots C / q and q / |e|^2. A closed cylinder is where that span and the one between
// the ends overlap: a ray through the rim cannot slip between side and cap, and nothing is decided
// twice.
//
// Leaving a surface: what leaves the outside, of side or cap, meets nothing of the cylinder again
// (every part lies on the boundary of a convex set, or within it: the open one, too). From the
// inside of the side the other root is 2 b / |e|^2, with b from the normal: exact, and without an
// epsilon.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "engine/math/axis.h"
#include "engine/objects/kind.h"

namespace raytracer {

struct Cylinder {
  Vec3 from;
  Vec3 to;
  double radius = 0;
  bool caps = true;

  static constexpr std::string_view type = "cylinder";
  static constexpr std::string_view description =
      "The surface around an axis; with caps closed by a disc at each end.";
  static constexpr auto fields =
      std::tuple(required("from", &Cylinder::from, PointRule{}, "Where the axis begins."),
                 required("to", &Cylinder::to, OtherPointRule{"from", "the axis has no direction"},
                          "Where it ends; must differ from from."),
                 required("radius", &Cylinder::radius, NumberRule{positive}),
                 optional("caps", &Cylinder::caps, FlagRule{}, "Whether the ends are closed."));
};

/// In order.
struct Cylinders {
  std::vector<Vec3> from;
  std::vector<Vec3> to;
  std::vector<double> radii;  ///< one for all, or one for each
  bool caps = true;
  std::vector<Rgb> colors;  ///< none, or one for each, in place of the material's

  double radius(std::size_t i) const { return radii.size() == 1 ? radii[0] : radii[i]; }

  static constexpr std::string_view type = "cylinders";
  static constexpr std::string_view description = "Many cylinders of one material.";
  static constexpr auto fields =
      std::tuple(required("from", &Cylinders::from, PointsRule{}, "Where the axes begin."),
                 required("to", &Cylinders::to, OtherPointPerItemRule{"from"}, "Where they end."),
                 required("radius", &Cylinders::radii, NumberPerItemRule{positive, "from"}),
                 optional("caps", &Cylinders::caps, FlagRule{}, "Whether the ends are closed."),
                 optional("colors", &Cylinders::colors, ColorPerItemRule{"from"}));
};

/// In frame coordinates.
struct PackedCylinder : AxisSegment {
  double radius;
  /// |foot|^2 - radius^2 of the unrounded foot: positive outside the endless cylinder
  double eye_c;
  bool has_caps;
  PrimitiveId id;
};

struct CylinderKind {
  using Documents = Types<Cylinder, Cylinders>;
  using Primitive = PackedCylinder;

  static constexpr std::string_view noun = "cylinder";
  static constexpr Search search = Search::bounded;
  // Random cylinders under two lights, packets of 16.
  static constexpr FewPrimitives few{.to_lights = 12, .followed = 24};
  static constexpr double pixels_for_cells = 12;
  static constexpr bool has_exact_shadows = false;
  static constexpr bool has_light_sweep = false;
  static constexpr double tolerance_px = 1.0 / 64;
};

inline std::size_t item_count(const Cylinder&) { return 1; }
inline std::size_t item_count(const Cylinders& c) { return c.from.size(); }

template <typename Include>
void for_each_extent(const Cylinder& c, const Include& include) {
  include(c.from, c.radius);
  include(c.to, c.radius);
}
template <typename Include>
void for_each_extent(const Cylinders& c, const Include& include) {
  for (std::size_t i = 0; i < c.from.size(); ++i) {
    include(c.from[i], c.radius(i));
    include(c.to[i], c.radius(i));
  }
}

void pack(const Cylinder& cylinder, Packing<PackedCylinder>& to);
void pack(const Cylinders& cylinders, Packing<PackedCylinder>& to);

PackedCylinder seen_from(const PackedCylinder& cylinder, const Vec3& place);

Box bounds(const PackedCylinder& cylinder);

inline PixelRectangle footprint(const Projection& projection, const PackedCylinder& c) {
  return projection.of_discs(c.end(false), c.radius, c.end(true), c.radius, c.axis);
}

/// From the origin to the surface, from outside of it; negative inside a closed cylinder.
double nearest_distance(const PackedCylinder& cylinder);

void add_statistics(const PackedCylinder& cylinder, const Viewpoint& from, GeometryStatistics& to);

inline void add_mirror(const PackedCylinder& c, CurvedMirrors& mirrors) {
  mirrors.include(0.5 * (c.end(false) + c.end(true)), c.radius, 1,
                  0.5 * (c.high - c.low) + c.radius);
}

inline std::optional<Placement> placement_of(const PackedCylinder& c) {
  return Placement{c.end(false), c.end(true), c.radius,
                   std::max(length(c.end(false)), length(c.end(true))) + c.radius};
}

/// Calls visit(rectangle, share) for pieces of it along the axis, if it may be seen thinner than a
/// pixel: what of the image a piece may cover, and the share that it does.
template <typename Visit>
void for_each_subpixel_piece(const PackedCylinder& c, const Projection& projection,
                             const Visit& visit) {
  const PixelRectangle whole = footprint(projection, c);
  const double width = whole.x_end - whole.x_begin;
  const double height = whole.y_end - whole.y_begin;
  constexpr double most_pieces = 4096;  // of one: more than an image is wide
  if (!(width > 0 && height > 0 && std::max(width, height) < most_pieces)) return;
  const int pieces = 1 + static_cast<int>(std::max(width, height));
  for (int i = 0; i < pieces; ++i) {
    const auto at = [&](double share) { return c.low + (c.high - c.low) * share / pieces; };
    const Vec3 one = c.foot + at(i) * c.axis;
    const Vec3 other = c.foot + at(i + 1) * c.axis;
    const PixelRectangle seen = projection.of_discs(one, c.radius, other, c.radius, c.axis);
    const PixelRectangle across = projection.of_sphere(0.5 * (one + other), c.radius);
    const double piece_width = seen.x_end - seen.x_begin;
    const double piece_height = seen.y_end - seen.y_begin;
    const double thickness = std::min(across.x_end - across.x_begin, across.y_end - across.y_begin);
    if (!(piece_width > 0 && piece_height > 0 && thickness > 0 && thickness < 1)) continue;
    const double area = thickness * std::hypot(piece_width, piece_height);
    visit(seen, std::min(area / (piece_width * piece_height), 1.0));
  }
}

std::optional<SurfaceHit> intersect(const Ray& ray, const PackedCylinder& cylinder);

}  // namespace raytracer
