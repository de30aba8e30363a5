// Triangles as packets of rays read them.
//
// Their sides are tested by what is known beforehand: the plane through the eye and a side, or its
// line as a distant light sees it. Two triangles that share a side have opposite ones, to the bit,
// and all are a few roundings generous, so that no ray slips between triangles at a side or a
// corner.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/finders/light_grid.h"
#include "engine/finders/point_grid.h"
#include "engine/lights/light_kind.h"
#include "engine/memory/page_allocator.h"
#include "engine/objects/numbering.h"
#include "engine/objects/packet_kind.h"
#include "engine/objects/triangle/triangle.h"
#include "engine/packets/flat_layout.h"

namespace raytracer {

template <typename T>
struct TriangleItem {
  std::array<Triple<T>, 3> corners;
  FlatItem<T> plane;  ///< through its corners; the id is the triangle's
};

/// The planes through the eye and the sides of a triangle: their unit normals, towards the
/// triangle.
template <typename T>
using TriangleCone = std::array<Triple<T>, 3>;

/// The lines of a triangle's sides as a distant light sees them: a point's distance from line i,
/// positive on the inner side, is u_slopes[i] u + v_slopes[i] v + offsets[i].
template <typename T>
struct TriangleOutline {
  std::array<T, 3> u_slopes, v_slopes, offsets;
};

/// What of space a triangle hides from a point light: between the planes through the light and its
/// sides, and beyond its own, which is the last. A point's distance from a plane is normal . point
/// - offset, positive where it may be hidden.
template <typename T>
struct TriangleShadow {
  std::array<Triple<T>, 4> normals;
  std::array<T, 4> offsets;
};

/// Up to eight triangles. Those that are not there have nothing that meets them.
template <typename T>
struct alignas(64) TriangleBlock {
  std::array<BlockColumn<T>, 9> corners;  ///< x, y, z of the first, the second and the third
  std::array<BlockColumn<T>, 3> normal;   ///< unit
  BlockColumn<T> height;                  ///< normal . (corner - eye)
  BlockColumn<T> id;
  std::uint32_t count;

  static TriangleBlock empty() { return {}; }  // no plane at height 0 without a normal is met
};

template <typename T>
struct TriangleEyeView {
  LargeArray<TriangleCone<T>> cones;  ///< where they are found by bins
};

template <typename T>
struct TriangleLightView {
  ListGrid<T> grid;                         ///< of a distant light
  LargeArray<TriangleOutline<T>> outlines;  ///< likewise, by triangle
  PointLists<T> lists;                      ///< of a point light
  LargeArray<TriangleShadow<T>> shadows;    ///< likewise, by triangle
};

/// Of the part of a triangle that the image can show: a lower bound of its depth.
inline double screen_depth(const Projection& projection, const PackedTriangle& t) {
  const auto& [a, b, c] = t.vertices;
  return std::max(0.0, std::min({projection.depth(a), projection.depth(b), projection.depth(c)}));
}

inline std::array<Line, 3> screen_outline(const View& view, const PackedTriangle& t) {
  return triangle_sides(view, t.vertices);
}

inline ShadowExtent shadow_extent(const PackedTriangle& t, const LightAxes& axes) {
  Box box;
  for (const Vec3& v : t.vertices)
    box.include(Vec3{dot(v, axes[0]), dot(v, axes[1]), dot(v, axes[2])});
  return {box.low.x, box.low.y, box.high.x, box.high.y, box.high.z};
}

template <typename T>
struct PacketLayout<TriangleKind, T> : DefaultLayout {
  using Item = TriangleItem<T>;
  using Block = TriangleBlock<T>;
  using EyeView = TriangleEyeView<T>;
  using LightView = TriangleLightView<T>;

  static bool needs_items(const FinderRow& finders) {
    const auto are_tried = [&](RayKind rays) {
      const Finder finder = finder_of(finders, rays);
      return finder != Finder::none && finder != Finder::tree;
    };
    return are_tried(RayKind::from_eye) || are_tried(RayKind::followed) ||
           are_tried(RayKind::to_distant_light) || are_tried(RayKind::to_soft_light) ||
           are_tried(RayKind::to_point_light);
  }

  static PrimitiveRow<T> row(const PackedTriangle& t, std::size_t /*item*/) {
    return flat_row<T>(t.normal, t.vertices[0]);
  }
  static Item item(const PackedTriangle& t, std::int32_t number) {
    const auto& [a, b, c] = t.vertices;
    return {{narrowed<T>(a), narrowed<T>(b), narrowed<T>(c)}, flat_item<T>(t.normal, a, number)};
  }
  static void fill(const PackedTriangle& triangle, std::int32_t number, std::size_t place,
                   Block& block);
  static EyeView eye_view(std::span<const PackedTriangle> triangles, const FinderRow& finders,
                          WorkerPool& pool);
  static LightView light_view(std::span<const PackedTriangle> triangles, const PackedLight& light,
                              const FinderRow& finders, const Numbering& numbers, WorkerPool& pool);
};

extern template struct PacketLayout<TriangleKind, float>;
extern template struct PacketLayout<TriangleKind, double>;

}  // namespace raytracer
