// How triangles lie in memory, and what the eye and the lights know of them beforehand.
#include "engine/objects/triangle/packets.h"

#include <cmath>
#include <limits>

#include "engine/parallel/chunks.h"

namespace raytracer {
namespace {

/// What a side's place is generous by, as a share of its corners' coordinates: so many roundings
/// has the distance from it of a point that may be much nearer to the eye.
constexpr double place_noise = 8 * std::numeric_limits<double>::epsilon();

struct Point {
  double u;
  double v;
};

/// The line from p to q, through the middle between them. Of q and p it is the opposite to the bit
/// but for what both are generous by, so that nothing lies outside of both triangles that share it.
/// `sign` is -1 where the inner side is the other one.
Line edge_line(const Point& p, const Point& q, double sign) {
  const double u = q.u - p.u;
  const double v = q.v - p.v;
  const double size = std::sqrt(u * u + v * v);
  const double scale = size > 0 ? sign / size : 0;
  const double per_u = -v * scale;
  const double per_v = u * scale;
  const double noise = place_noise * (std::abs(p.u + q.u) + std::abs(p.v + q.v));
  return {noise - 0.5 * (per_u * (p.u + q.u) + per_v * (p.v + q.v)), per_u, per_v};
}

/// Of a triangle that the light sees as a line or a point everything is outside.
template <typename T>
TriangleOutline<T> outline(const LightAxes& axes, const PackedTriangle& triangle) {
  std::array<Point, 3> corners;
  for (std::size_t i = 0; i < 3; ++i)
    corners[i] = {dot(triangle.vertices[i], axes[0]), dot(triangle.vertices[i], axes[1])};
  const auto& [a, b, c] = corners;
  const double turn = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
  const double sign = turn < 0 ? -1 : 1;
  TriangleOutline<T> lines;
  if (turn == 0) {
    lines.u_slopes.fill(T(0));
    lines.v_slopes.fill(T(0));
    lines.offsets.fill(std::numeric_limits<T>::lowest());
    return lines;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Line line = edge_line(corners[i], corners[(i + 1) % 3], sign);
    lines.u_slopes[i] = static_cast<T>(line.per_x);
    lines.v_slopes[i] = static_cast<T>(line.per_y);
    lines.offsets[i] = static_cast<T>(line.at_origin);
  }
  return lines;
}

template <typename T>
std::array<Line, 3> lines_of(const TriangleOutline<T>& outline) {
  std::array<Line, 3> lines;
  for (std::size_t i = 0; i < 3; ++i)
    lines[i] = {outline.offsets[i], outline.u_slopes[i], outline.v_slopes[i]};
  return lines;
}

/// The planes through a light and a triangle's sides: of one that two triangles share the opposite
/// for the other, to the bit but for what both are generous by. Nothing is inside if the light is
/// in the triangle's own plane, or sees two corners at one place.
template <typename T>
TriangleShadow<T> shadow_of(const Vec3& light, const PackedTriangle& t) {
  constexpr double noise = 64 * std::numeric_limits<double>::epsilon();
  TriangleShadow<T> none;
  none.normals.fill({});
  none.offsets.fill(T(1));
  const PackedTriangle seen = seen_from(t, light);
  const double height = dot(t.normal, seen.vertices[0]);
  const Vec3 away = height < 0 ? -t.normal : t.normal;
  if (!(std::abs(height) > noise * length(seen.vertices[0]))) return none;
  // By the sides themselves, which the light's distance rounds nothing off.
  const auto& [a, b, c] = t.vertices;
  const double sign = dot(cross(b - a, c - a), seen.vertices[0]) < 0 ? -1 : 1;
  TriangleShadow<T> shadow;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    const Vec3 across =
        cross(seen.vertices[i] + seen.vertices[next], t.vertices[next] - t.vertices[i]);
    if (!(length(across) > 0)) return none;
    const Vec3 normal = sign * unit(across);
    shadow.normals[i] = narrowed<T>(normal);
    const Vec3 middle = 0.5 * (t.vertices[i] + t.vertices[next]);
    shadow.offsets[i] = static_cast<T>(dot(normal, middle) - 2 * place_noise * length(middle));
  }
  shadow.normals[3] = narrowed<T>(away);
  shadow.offsets[3] = static_cast<T>(dot(away, t.vertices[0]));
  return shadow;
}

/// In double up to the last step, and by the sides themselves: corners near each other as seen from
/// the eye give a side's plane all its digits.
template <typename T>
TriangleCone<T> eye_cone(const PackedTriangle& triangle) {
  const auto& [a, b, c] = triangle.vertices;
  const double sign = dot(cross(b - a, c - a), a) < 0 ? -1 : 1;
  const auto plane = [sign](const Vec3& from, const Vec3& to) {
    return narrowed<T>(sign * unit(cross(from + to, to - from)));
  };
  return {plane(a, b), plane(b, c), plane(c, a)};
}

}  // namespace

template <typename T>
void PacketLayout<TriangleKind, T>::fill(const PackedTriangle& triangle, std::int32_t number,
                                         std::size_t place, TriangleBlock<T>& block) {
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const Vec3& vertex = triangle.vertices[corner];
    block.corners[3 * corner][place] = static_cast<T>(vertex.x);
    block.corners[3 * corner + 1][place] = static_cast<T>(vertex.y);
    block.corners[3 * corner + 2][place] = static_cast<T>(vertex.z);
  }
  block.normal[0][place] = static_cast<T>(triangle.normal.x);
  block.normal[1][place] = static_cast<T>(triangle.normal.y);
  block.normal[2][place] = static_cast<T>(triangle.normal.z);
  block.height[place] = static_cast<T>(dot(triangle.normal, triangle.vertices[0]));
  block.id[place] = static_cast<T>(number);
}

template <typename T>
TriangleEyeView<T> PacketLayout<TriangleKind, T>::eye_view(
    std::span<const PackedTriangle> triangles, const FinderRow& finders, WorkerPool& pool) {
  TriangleEyeView<T> view;
  if (finder_of(finders, RayKind::from_eye) != Finder::screen_bins) return view;
  view.cones.resize(triangles.size());
  for_each_range(triangles.size(), pool, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) view.cones[i] = eye_cone<T>(triangles[i]);
  });
  return view;
}

template <typename T>
TriangleLightView<T> PacketLayout<TriangleKind, T>::light_view(
    std::span<const PackedTriangle> triangles, const PackedLight& light, const FinderRow& finders,
    const Numbering&, WorkerPool& pool) {
  TriangleLightView<T> view;
  if (light.rays == LightRays::converging) {
    const Finder finder = finder_of(finders, RayKind::to_point_light);
    if (finder == Finder::tree) return view;
    view.shadows.resize(triangles.size());
    for_each_range(triangles.size(), pool, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        view.shadows[i] = shadow_of<T>(light.place, triangles[i]);
    });
    if (finder == Finder::point_grid)
      view.lists = build_point_lists<T>(light.place, triangles, reach_of(triangles, pool), pool);
    return view;
  }
  const Finder finder = finder_of(finders, ray_kind_of(light));
  if (finder == Finder::tree) return view;
  const LightAxes axes = light_axes(light.place);
  view.outlines.resize(triangles.size());
  for_each_range(triangles.size(), pool, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) view.outlines[i] = outline<T>(axes, triangles[i]);
  });
  view.grid.plane.axes = in_precision<T>(axes);
  if (finder != Finder::light_grid) return view;
  const auto outline_of = [&view](std::size_t i) { return lines_of(view.outlines[i]); };
  view.grid = build_list_grid<T>(light.place, triangles, outline_of, pool);
  return view;
}

template struct PacketLayout<TriangleKind, float>;
template struct PacketLayout<TriangleKind, double>;

}  // namespace raytracer
