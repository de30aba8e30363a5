// Triangles in frame coordinates, and what the plan has to know of them: how near, far and
// large they are.
#include <algorithm>

#include "engine/objects/triangle/triangle.h"

namespace raytracer {
namespace {

/// The direction across a triangle; zero for one of no area. Of the two shorter sides, which meet
/// opposite the longest: a needle's short side is a difference without rounding, so that the normal
/// keeps its digits.
Vec3 normal_across(const std::array<Vec3, 3>& corners) {
  std::array<Vec3, 3> sides;
  for (std::size_t i = 0; i < 3; ++i) sides[i] = corners[(i + 1) % 3] - corners[i];
  std::array<double, 3> sizes;
  for (std::size_t i = 0; i < 3; ++i) sizes[i] = max_abs(sides[i]);
  std::size_t longest = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (sizes[i] > sizes[longest]) longest = i;
  const std::size_t one = (longest + 1) % 3;
  const std::size_t other = (longest + 2) % 3;
  const double product = sizes[one] * sizes[other];
  if (product > 0x1p-400 && product < 0x1p400) return unit(cross(sides[one], sides[other]));
  return unit(cross(unit(sides[one]), unit(sides[other])));
}

double reach(const PackedTriangle& t) {
  return std::max({max_abs(t.vertices[0]), max_abs(t.vertices[1]), max_abs(t.vertices[2])});
}

bool is_too_small(const PackedTriangle& t) { return !Frame::carries(reach(t)); }

/// Whether rays cannot tell its corners apart, from each other or from the eye; between corners
/// that all are one place, every ray would pass.
bool has_no_extent(const PackedTriangle& t) {
  const auto& [a, b, c] = t.vertices;
  return t.normal == Vec3{} || (a == b && b == c) || is_too_small(t);
}

/// The distance of the corner that is farthest from a place.
double farthest_of(const PackedTriangle& t, const Vec3& place) {
  double square = 0;
  for (const Vec3& vertex : t.vertices)
    square = std::max(square, dot(vertex - place, vertex - place));
  return std::sqrt(square);
}

/// A ball around a triangle, and a lower bound of a place's distance to the triangle: that of the
/// ball or of the plane.
struct TriangleBall {
  double radius;
  double distance;

  TriangleBall(const PackedTriangle& t, const Vec3& place) {
    const auto& [a, b, c] = t.vertices;
    const Vec3 middle = (a + b + c) / 3;
    radius = farthest_of(t, middle);
    const double to_plane = std::abs(dot(t.normal, a - place));
    distance = std::max({to_plane, length(middle - place) - radius, 0.0});
  }
};

}  // namespace

void pack(const Mesh& mesh, Packing<PackedTriangle>& to) {
  std::vector<Vec3> vertices(mesh.vertices.size());
  for_each_range(vertices.size(), to.pool, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      vertices[i] = to.frame.frame_from_scene(mesh.vertices[i]);
  });
  const auto make = [&](std::size_t i) {
    const auto& [a, b, c] = mesh.triangles[i];
    PackedTriangle triangle{{vertices[a], vertices[b], vertices[c]}, {}, {to.object, i}};
    // In the scene's coordinates, which are not yet rounded, if their differences are finite.
    triangle.normal = normal_across({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
    if (!std::isfinite(max_abs(triangle.normal)))
      triangle.normal = normal_across(triangle.vertices);
    return triangle;
  };
  to.add_all(mesh.triangles.size(), make, has_no_extent, is_too_small);
}

CornerValues corner_values(const Mesh& mesh) {
  CornerValues values;
  if (mesh.normals.empty() && mesh.vertex_colors.empty()) return values;
  values.corners = mesh.triangles;
  values.normals = mesh.normals;
  values.colors = mesh.vertex_colors;
  return values;
}

double nearest_distance(const PackedTriangle& triangle) {
  return TriangleBall(triangle, {}).distance;
}

void add_statistics(const PackedTriangle& t, const Viewpoint& from, GeometryStatistics& to) {
  const TriangleBall ball(t, from.place);
  to.note_surface(ball.distance);
  to.smallest = std::min(to.smallest, reach(t));
  to.farthest = std::max(to.farthest, farthest_of(t, from.place));
  to.note_blocks(from.blocks(ball.radius / ball.distance), ball.distance);
}

}  // namespace raytracer
