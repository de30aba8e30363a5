// A polygon as triangles, by ear clipping in its plane: G. Meisters, "Polygons have ears", American
// Mathematical Monthly 82 (1975). A corner that cuts off a triangle without another corner inside
// is an ear; what remains is a polygon with one corner less.
//
// Corners may be concave, coincide, or lie on a line; a slit may lead to a hole. Each ear looks at
// the concave corners only, so that convex polygons take time in proportion to their corners; a
// star of 20,000 corners takes a second.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace raytracer::client {

struct Triangulation {
  std::array<double, 3> normal{};  ///< by the right hand round the polygon, of any length
  /// Corners by index, with the polygon's own sense of rotation; none if it has no area.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Its sides cross, so that no triangles fill it exactly.
  bool crosses_itself = false;
};

/// `corners` are at least three, near a plane.
Triangulation triangulate(const std::vector<std::array<double, 3>>& corners);

}  // namespace raytracer::client
