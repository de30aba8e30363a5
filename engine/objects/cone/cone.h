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
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "engine/math/axis.h"
#include "engine/objects/kind.h"

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

/// In frame coordinates.
struct PackedCone : AxisSegment {
  double radius_from;
  double radius_to;
  double cosine;         ///< of half the apex angle
  double sine;           ///< positive if it widens along the axis
  double girth_at_foot;  ///< the cosine times the radius, negative beyond the tip
  double eye_c;          ///< of the eye C: positive outside the endless cone and its mirror image
  bool has_caps;
  PrimitiveId id;

  double radius(bool is_to) const { return is_to ? radius_to : radius_from; }
  double largest_radius() const { return std::max(radius_from, radius_to); }
  double girth(double along) const { return girth_at_foot + sine * along; }
};

struct ConeKind {
  using Documents = Types<Cone, Cones>;
  using Primitive = PackedCone;

  static constexpr std::string_view noun = "cone";
  static constexpr Search search = Search::bounded;
  // Random cones under two lights, packets of 16.
  static constexpr FewPrimitives few{.to_lights = 12, .followed = 24};
  static constexpr double pixels_for_cells = 12;
  static constexpr bool has_exact_shadows = false;
  static constexpr bool has_light_sweep = false;
  static constexpr double tolerance_px = 1.0 / 64;
};

inline std::size_t item_count(const Cone&) { return 1; }
inline std::size_t item_count(const Cones& c) { return c.from.size(); }

template <typename Include>
void for_each_extent(const Cone& c, const Include& include) {
  include(c.from, c.radius_from);
  include(c.to, c.radius_to);
}
template <typename Include>
void for_each_extent(const Cones& c, const Include& include) {
  for (std::size_t i = 0; i < c.from.size(); ++i) {
    include(c.from[i], c.radius_from(i));
    include(c.to[i], c.radius_to(i));
  }
}

void pack(const Cone& cone, Packing<PackedCone>& to);
void pack(const Cones& cones, Packing<PackedCone>& to);

PackedCone seen_from(const PackedCone& cone, const Vec3& place);

Box bounds(const PackedCone& cone);

inline PixelRectangle footprint(const Projection& projection, const PackedCone& c) {
  return projection.of_discs(c.end(false), c.radius_from, c.end(true), c.radius_to, c.axis);
}

/// From the origin to the surface, from outside of it; negative inside a closed cone.
double nearest_distance(const PackedCone& cone);

void add_statistics(const PackedCone& cone, const Viewpoint& from, GeometryStatistics& to);

/// A tip magnifies without end, but what a mirror shows near it is small: by its mean radius.
inline void add_mirror(const PackedCone& c, CurvedMirrors& mirrors) {
  mirrors.include(0.5 * (c.end(false) + c.end(true)), 0.5 * (c.radius_from + c.radius_to), 1,
                  0.5 * (c.high - c.low) + c.largest_radius());
}

inline std::optional<Placement> placement_of(const PackedCone& c) {
  return Placement{
      c.end(false), c.end(true), c.radius_from + c.radius_to,
      std::max(length(c.end(false)) + c.radius_from, length(c.end(true)) + c.radius_to)};
}

/// Calls visit(rectangle, share) for pieces of it along the axis where it may be seen thinner than
/// a pixel: what of the image a piece may cover, and the share that it does.
template <typename Visit>
void for_each_subpixel_piece(const PackedCone& c, const Projection& projection,
                             const Visit& visit) {
  const PixelRectangle whole = footprint(projection, c);
  const double width = whole.x_end - whole.x_begin;
  const double height = whole.y_end - whole.y_begin;
  constexpr double most_pieces = 4096;  // of one: more than an image is wide
  if (!(width > 0 && height > 0 && std::max(width, height) < most_pieces)) return;
  const int pieces = 1 + static_cast<int>(std::max(width, height));
  const auto between = [](double from, double to, double share) {
    return from + (to - from) * share;
  };
  for (int i = 0; i < pieces; ++i) {
    const auto center = [&](double at) {
      return c.foot + between(c.low, c.high, at / pieces) * c.axis;
    };
    const auto radius = [&](double at) { return between(c.radius_from, c.radius_to, at / pieces); };
    const PixelRectangle seen =
        projection.of_discs(center(i), radius(i), center(i + 1), radius(i + 1), c.axis);
    const PixelRectangle across = projection.of_sphere(center(i + 0.5), radius(i + 0.5));
    const double piece_width = seen.x_end - seen.x_begin;
    const double piece_height = seen.y_end - seen.y_begin;
    const double thickness = std::min(across.x_end - across.x_begin, across.y_end - across.y_begin);
    if (!(piece_width > 0 && piece_height > 0 && thickness > 0 && thickness < 1)) continue;
    const double area = thickness * std::hypot(piece_width, piece_height);
    visit(seen, std::min(area / (piece_width * piece_height), 1.0));
  }
}

std::optional<SurfaceHit> intersect(const Ray& ray, const PackedCone& cone);

}  // namespace raytracer
