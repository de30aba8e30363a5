// Meshes of triangles.
//
//   { "type": "mesh", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "triangles": [[0, 1, 2]],
//     "normals": [[0, 0, 1], [0.1, 0, 1], [0, 0.1, 1]], "colors": ["#ff0000", "#00ff00", "#0000ff"]
//     }
//
// A triangle's distance is its plane's, computed as a plane's is: a mesh lying in a plane ties with
// it exactly. Whether the ray passes inside is decided in the plane across it: a corner that two
// triangles share is projected to the same point for both, and an edge that they share gives
// opposite signs, which rounding can make 0 but never wrong, so no ray slips between them (Woop,
// Benthin, Wald: "Watertight Ray/Triangle Intersection", JCGT 2013; here with an orthonormal basis
// around the ray instead of a shear).
//
// Leaving a surface: what lies in the plane that a ray leaves, or behind it, is not met; that is
// asked of the corners, which are exact (math/ray_plane.h).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "engine/objects/corner_values.h"
#include "engine/objects/kind.h"

namespace raytracer {

struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into vertices
  std::vector<Vec3> normals;       ///< none, or one for each vertex, of any length but 0
  std::vector<Rgb> vertex_colors;  ///< none, or one for each vertex, in place of the material's

  static constexpr std::string_view type = "mesh";
  static constexpr std::string_view description =
      "Triangles, each with its geometric normal or, smooth, with those of its corners.";
  static constexpr auto fields = std::tuple(
      required("vertices", &Mesh::vertices, PointsRule{}),
      required("triangles", &Mesh::triangles, TriplesRule{"vertices"},
               "Triples of indices into vertices."),
      optional("normals", &Mesh::normals, DirectionPerItemRule{"vertices"},
               "One for each vertex: interpolated, lengths and all, they shade the triangles."),
      optional("colors", &Mesh::vertex_colors, ColorPerItemRule{"vertices"},
               "One for each vertex, interpolated, in place of the material's."));
};

/// In frame coordinates.
struct PackedTriangle {
  std::array<Vec3, 3> vertices;
  Vec3 normal;  ///< unit
  PrimitiveId id;
};

struct TriangleKind {
  using Documents = Types<Mesh>;
  using Primitive = PackedTriangle;

  static constexpr std::string_view noun = "triangle";
  static constexpr Search search = Search::bounded;
  static constexpr FewPrimitives few{.to_lights = 4, .followed = 0};
  // 27,648 triangles of toothed wheels under five lights, built and traced, cells against a tree:
  // with 12.7 pixels for each 142 ms to 144, with 0.7 45 to 19.
  static constexpr double pixels_for_cells = 12;
  /// Planes through the light and its sides part what it hides: they are as exact as the point.
  static constexpr bool has_exact_shadows = true;
  static constexpr bool has_light_sweep = false;
  /// At edges that two share more is left to rounding than at a silhouette.
  static constexpr double tolerance_px = 1.0 / 256;
};

inline std::size_t item_count(const Mesh& mesh) { return mesh.triangles.size(); }

template <typename Include>
void for_each_extent(const Mesh& mesh, const Include& include) {
  for (const Vec3& vertex : mesh.vertices) include(vertex, 0);
}

inline bool has_corner_normals(const Mesh& mesh) { return !mesh.normals.empty(); }
inline const std::vector<Rgb>& corner_colors(const Mesh& mesh) { return mesh.vertex_colors; }
CornerValues corner_values(const Mesh& mesh);

/// Triangles of no area are left out, too.
void pack(const Mesh& mesh, Packing<PackedTriangle>& to);

inline const std::array<Vec3, 3>& corners_of(const PackedTriangle& t) { return t.vertices; }

inline PackedTriangle seen_from(const PackedTriangle& t, const Vec3& place) {
  return {{t.vertices[0] - place, t.vertices[1] - place, t.vertices[2] - place}, t.normal, t.id};
}

inline Box bounds(const PackedTriangle& triangle) {
  Box box;
  for (const Vec3& vertex : triangle.vertices) box.include(vertex);
  return box;
}

inline double plane_distance(const PackedTriangle& t) {
  return std::abs(dot(t.normal, t.vertices[0]));
}

inline PixelRectangle footprint(const Projection& projection, const PackedTriangle& t) {
  return projection.of_triangle(t.vertices, plane_distance(t));
}

/// From the origin: of the plane or of a corner, whichever tells more.
double nearest_distance(const PackedTriangle& triangle);

void add_statistics(const PackedTriangle& triangle, const Viewpoint& from, GeometryStatistics& to);

inline void add_mirror(const PackedTriangle&, CurvedMirrors&) {}  // it magnifies nothing

inline std::optional<Placement> placement_of(const PackedTriangle&) { return {}; }

std::optional<SurfaceHit> intersect(const Ray& ray, const PackedTriangle& triangle);

}  // namespace raytracer
