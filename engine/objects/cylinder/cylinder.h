// Cylinders: one, or many of one material; with caps closed by a disc at each end, without them
// open.
//
//   { "type": "cylinder", "from": [0, 0, 0], "to": [0, 3, 0], "radius": 0.5, "caps": true }
//   { "type": "cylinders", "from": [[0, 0, 0], [1, 0, 0]], "to": [[0, 1, 0], [1, 2, 0]],
//     "radius": 0.1, "colors": ["#ff0000", "#00ff00"] }
//
// Everything is measured from the foot of its axis (math/axis.h). A ray meets the endless cylinder
// in the plane across the axis, in the residual form that spheres have (math/ray_sphere.h): with f
// from the foot and g the direction's part across the axis, x = f x g and b = -f.g do not cancel,
// nor do the roots C / q and q / |g|^2. A closed cylinder is where that span and the one between
// the ends overlap: a ray through the rim cannot slip between side and cap, and nothing is decided
// twice.
//
// Leaving a surface: what leaves the outside, of side or cap, meets nothing of the cylinder again
// (every part lies on the boundary of a convex set, or within it: the open one, too). From the
// inside of the side the other root is 2 b / |g|^2, with b from the normal: exact, and without an
// epsilon.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "engine/objects/axial.h"

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
  Cylinder operator[](std::size_t i) const { return {from[i], to[i], radius(i), caps}; }

  static constexpr std::string_view type = "cylinders";
  static constexpr std::string_view description = "Many cylinders of one material.";
  static constexpr auto fields =
      std::tuple(required("from", &Cylinders::from, PointsRule{}, "Where the axes begin."),
                 required("to", &Cylinders::to, OtherPointPerItemRule{"from"}, "Where they end."),
                 required("radius", &Cylinders::radii, NumberPerItemRule{positive, "from"}),
                 optional("caps", &Cylinders::caps, FlagRule{}, "Whether the ends are closed."),
                 optional("colors", &Cylinders::colors, ColorPerItemRule{"from"}));
};

/// In frame coordinates; eye_power is |foot|^2 - radius^2 of the unrounded foot.
struct PackedCylinder : AxialSolid {
  double radius;
};

struct CylinderKind : AxialTraits {
  using Documents = Types<Cylinder, Cylinders>;
  using Primitive = PackedCylinder;
  static constexpr std::string_view noun = "cylinder";
};

inline double end_radius(const Cylinder& c, bool) { return c.radius; }
inline double end_radius(const PackedCylinder& c, bool) { return c.radius; }

PackedCylinder packed(const Cylinder& cylinder, const PrimitiveId& id, const Frame& frame);

PackedCylinder seen_from(const PackedCylinder& cylinder, const Vec3& place);

double distance_to_surface(const PackedCylinder& cylinder, const Vec3& place);

inline double smallest_squared_length(const PackedCylinder& c) { return c.radius; }

inline std::optional<Placement> placement_of(const PackedCylinder& c) {
  return Placement{c.end(false), c.end(true), c.radius,
                   std::max(length(c.end(false)), length(c.end(true))) + c.radius};
}

std::optional<SurfaceHit> intersect(const Ray& ray, const PackedCylinder& cylinder);

}  // namespace raytracer
