// The square of touching spheres: one object, at a cost that does not depend on how many there are.
//
//   { "type": "sphere_square", "center": [0, -3, 0], "radius": 0.5, "n": 14, "axes": "xz" }
//
// Its spheres stand in rows. The reference takes rows along that spanning axis to which the ray is
// more nearly parallel, so that it crosses few; within a row the spheres that it meets are found by
// a formula: the ray is closest to the row's axis, at distance delta, above the point x*, and a
// centre at x on the axis is at distance sqrt(delta^2 + (x - x*)^2 sin^2) from the ray, sin being
// that of the angle between ray and row. Centres are computed from their indices, never by adding
// up.
//
// Limits: a ray that lies in the lattice's own plane and misses every sphere on its way visits
// every row that it crosses.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include "engine/objects/kind.h"

namespace raytracer {

/// The two coordinates that span a square: indices into {x, y, z}.
enum class Axes : std::uint8_t { xz, xy, yz };

/// 2n x 2n touching spheres around a centre.
struct SphereSquare {
  Vec3 center;
  double radius = 0;
  std::int64_t n = 1;
  Axes axes = Axes::xz;

  static constexpr std::string_view type = "sphere_square";
  static constexpr std::string_view description = "The square of 2n x 2n touching spheres.";
  static constexpr auto fields =
      std::tuple(required("center", &SphereSquare::center, PointRule{}),
                 required("radius", &SphereSquare::radius, NumberRule{positive}),
                 required("n", &SphereSquare::n, IntegerRule{1, 1'000'000'000}),
                 optional("axes", &SphereSquare::axes, ChoiceRule{"xz", "xy", "yz"}));
};

/// In frame coordinates; the two spanning axes and the one across them as indices.
struct PackedLattice {
  Vec3 center;
  double radius;
  std::int64_t side;  ///< spheres along a side: 2n
  int first_axis;
  int second_axis;
  int across;
  PrimitiveId id;

  double half_side() const { return static_cast<double>(side) * radius; }
};

struct LatticeKind {
  using Documents = Types<SphereSquare>;
  using Primitive = PackedLattice;

  static constexpr std::string_view noun = "sphere square";
  static constexpr Search search = Search::own;
  static constexpr bool has_exact_shadows = false;
  static constexpr bool has_light_sweep = false;
  static constexpr double tolerance_px = 1.0 / 64;
};

inline std::size_t item_count(const SphereSquare&) { return 1; }

template <typename Include>
void for_each_extent(const SphereSquare& s, const Include& include) {
  include(s.center, std::min(2.0 * static_cast<double>(s.n) * s.radius, 1e308));
}

void pack(const SphereSquare& square, Packing<PackedLattice>& to);

Box bounds(const PackedLattice& lattice);

inline PixelRectangle footprint(const Projection& projection, const PackedLattice& lattice) {
  return projection.of_box(bounds(lattice));
}

void add_statistics(const PackedLattice& lattice, const Viewpoint& from, GeometryStatistics& to);

inline void add_mirror(const PackedLattice& l, CurvedMirrors& mirrors) {
  const auto side = static_cast<double>(l.side);
  mirrors.include(l.center, l.radius, side * side, l.half_side());
}

inline std::optional<Placement> placement_of(const PackedLattice&) { return {}; }

/// The nearest hit at t > 0; the id's item is first index * side + second.
std::optional<SurfaceHit> intersect(const Ray& ray, const PackedLattice& lattice);

/// The longest way between one of the lattice's spheres and what receives its shadow under a light
/// from `towards` (unit). It shadows itself from cell to cell, which no distance makes less
/// accurate; other things, in the box `all` around everything, only from as far as the light's
/// slope takes a ray from their height to its own.
double shadow_path(const PackedLattice& lattice, const Vec3& towards, const Box& all);

/// "a square of 28 x 28 spheres"
std::string name_of(LatticeKind, std::size_t count, const GeometryStatistics& statistics);

/// How rays from a lattice's own spheres to distant lights find what is in their way, the lowest of
/// the lights with this sine of its elevation.
struct NeighbourSearch {
  std::string finder;
  std::string reason;
};
NeighbourSearch explain_neighbours(LatticeKind, double lowest_light);

/// The sine of the light's elevation over the lattice's plane.
double elevation_sine(const PackedLattice& lattice, const Vec3& towards);

/// The least of these sines at which a list of neighbours finds what shadows a lattice's spheres;
/// below (about 3.4 degrees) the list grows long, and a walk takes over.
inline constexpr double lowest_neighbour_slope = 0.06;

}  // namespace raytracer
