// The kinds of rays, and the finders: by what rays find the primitives of a kind of object.
//
// Rays that share an origin or a direction need a 2-D structure only; a tree is for those that
// share neither, and for primitives so large that they would be in too many cells of the former.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace raytracer {

/// Which rays share what.
enum class RayKind : std::uint8_t {
  from_eye,
  to_distant_light,  ///< all parallel
  to_soft_light,     ///< all parallel, to one of the directions of a distant disc or of a sky
  to_point_light,    ///< all end at one point
  /// Reflected or refracted, or to a disc around a place or a sky of limited reach: they share
  /// nothing.
  followed,
};
inline constexpr std::size_t ray_kind_count = 5;

/// How rays find primitives.
enum class Finder : std::uint8_t {
  none,         ///< there are no such rays, or nothing that they could meet
  one_by_one,   ///< each primitive is tried
  screen_bins,  ///< a list for each block of pixels
  light_grid,   ///< a list for each cell of a plane across a light's direction
  light_sweep,  ///< the points in the cells of such a plane, over which each primitive passes
  point_grid,   ///< a list for each cell of a cube around a point light
  tree,         ///< boxes in boxes
  lattice_walk  ///< the kind's own: from cell to cell of a regular pattern
};

/// One kind of object's row of the table [kind of object][kind of ray].
using FinderRow = std::array<Finder, ray_kind_count>;

/// That of some kind of rays.
constexpr Finder finder_of(const FinderRow& row, RayKind rays) {
  return row[static_cast<std::size_t>(rays)];
}

/// How a kind's primitives can be found.
enum class Search : std::uint8_t {
  bounded,    ///< by structures over their bounds
  unbounded,  ///< one by one: they are everywhere
  own,        ///< by the kind itself, which finds its own parts
};

/// Up to how many primitives of a kind trying each is faster than any structure.
struct FewPrimitives {
  std::size_t to_lights;
  std::size_t followed;
};

}  // namespace raytracer
