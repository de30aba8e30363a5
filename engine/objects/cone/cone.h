// Cones, whole or cut off: one, or many of one material; the radius goes linearly from one end to
// the other. With caps they are closed by a disc at each end that has a radius, without them open.
//
//   { "type": "cone", "from": [0, 0, 0], "to": [0, 3, 0], "radius_from": 1, "radius_to": 0 }
//   { "type": "cones", "from": [[0, 0, 0], [4, 0, 0]], "to": [[0, 1, 0], [4, 2, 0]],
//     "radius_from": 0.5, "radius_to": [0.1, 0.2], "colors": ["#ff0000", "#00ff00"] }
//
// Across the axis all is measured in cosines of half the apex angle, and so are radii, which are
// then called girths: |F| = girth is the side, which rises at 45 degrees whatever the cone, and
// |F| - girth is the distance from it. With F from the axis to the ray's origin, G the direction's
// part across the axis, m the girth there and n what it grows by along the ray, the side is met at
// the roots of a t^2 - 2 b t + C with a = G.G - n^2, b = m n - F.G, C = F.F - m^2; and
//
//   b^2 - a C = |m G - n F|^2 - (F x G)^2,
//
// in which no squares of distances cancel: the first is the place where the girth is 0, the second
// how far the ray passes from the axis. All is measured from the foot of the axis (math/axis.h).
//
// What a ray through a closed cone meets is decided where the answer is well-conditioned, however
// flat or slender it is: whether it passes through the disc at either end, and else, whether it is
// within the side where it is deepest, between the ends. No ray slips between side and cap.
//
// Leaving a surface: what leaves the outside meets nothing of the cone again, which is part of the
// boundary of a convex set. From the inside of the side the other root is 2 b / a, with b from the
// normal: exact, and without an epsilon.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "engine/objects/axial.h"

namespace raytracer {

struct Cone {
  Vec3 from;
  Vec3 to;
  double radius_from = 0;
  double radius_to = 0;
  bool caps = true;

  static constexpr std::string_view type = "cone";
  static constexpr std::string_view description =
      "The surface around an axis, whose radius goes linearly from one end to the other; with caps "
      "closed by a disc at each end that has a radius.";
  static constexpr auto fields =
      std::tuple(required("from", &Cone::from, PointRule{}, "Where the axis begins."),
                 required("to", &Cone::to, OtherPointRule{"from", "the axis has no direction"},
                          "Where it ends; must differ from from."),
                 required("radius_from", &Cone::radius_from, NumberRule{not_negative}),
                 required("radius_to", &Cone::radius_to, NotBothZeroRule{"radius_from"},
                          "Not 0 where radius_from is."),
                 optional("caps", &Cone::caps, FlagRule{}, "Whether the ends are closed."));
};

/// In order.
struct Cones {
  std::vector<Vec3> from;
  std::vector<Vec3> to;
  std::vector<double> radii_from;  ///< one for all, or one for each
  std::vector<double> radii_to;
  bool caps = true;
  std::vector<Rgb> colors;  ///< none, or one for each, in place of the material's

  double radius_from(std::size_t i) const { return radii_from[radii_from.size() == 1 ? 0 : i]; }
  double radius_to(std::size_t i) const { return radii_to[radii_to.size() == 1 ? 0 : i]; }
  Cone operator[](std::size_t i) const {
    return {from[i], to[i], radius_from(i), radius_to(i), caps};
  }

  static constexpr std::string_view type = "cones";
  static constexpr std::string_view description = "Many cones of one material.";
  static constexpr auto fields = std::tuple(
      required("from", &Cones::from, PointsRule{}, "Where the axes begin."),
      required("to", &Cones::to, OtherPointPerItemRule{"from"}, "Where they end."),
      required("radius_from", &Cones::radii_from, NumberPerItemRule{not_negative, "from"}),
      required("radius_to", &Cones::radii_to, NotBothZeroPerItemRule{"from", "radius_from"},
               "Not 0 where radius_from is."),
      optional("caps", &Cones::caps, FlagRule{}, "Whether the ends are closed."),
      optional("colors", &Cones::colors, ColorPerItemRule{"from"}));
};

/// In frame coordinates; eye_power is of the eye C: positive outside the endless cone and its
/// mirror image.
struct PackedCone : AxialSolid {
  double radius_from;
  double radius_to;
  double cosine;         ///< of half the apex angle
  double sine;           ///< positive if it widens along the axis
  double girth_at_foot;  ///< the cosine times the radius, negative beyond the tip

  double radius(bool is_to) const { return is_to ? radius_to : radius_from; }
  double girth(double along) const { return girth_at_foot + sine * along; }
};

struct ConeKind : AxialTraits {
  using Documents = Types<Cone, Cones>;
  using Primitive = PackedCone;
  static constexpr std::string_view noun = "cone";
};

inline double end_radius(const Cone& c, bool is_to) { return is_to ? c.radius_to : c.radius_from; }
inline double end_radius(const PackedCone& c, bool is_to) { return c.radius(is_to); }

PackedCone packed(const Cone& cone, const PrimitiveId& id, const Frame& frame);

PackedCone seen_from(const PackedCone& cone, const Vec3& place);

double distance_to_surface(const PackedCone& cone, const Vec3& place);

/// Of girths single holds the squares.
inline double smallest_squared_length(const PackedCone& c) {
  return c.cosine * std::max(c.radius_from, c.radius_to);
}

inline std::optional<Placement> placement_of(const PackedCone& c) {
  return Placement{
      c.end(false), c.end(true), c.radius_from + c.radius_to,
      std::max(length(c.end(false)) + c.radius_from, length(c.end(true)) + c.radius_to)};
}

std::optional<SurfaceHit> intersect(const Ray& ray, const PackedCone& cone);

}  // namespace raytracer
