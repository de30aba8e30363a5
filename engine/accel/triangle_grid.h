// Which triangles may stand between a point and a distant light.
//
// All rays to the light share their direction, so a 2-D structure finds what they meet: a grid on
// the plane across it, as for spheres. A cell lists the triangles that it touches, those that reach
// nearest to the light first.
//
// Limits: only what a ray may meet. Sides are a little generous; whether a triangle really stands
// before a point is decided by its corners.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/accel/binning.h"
#include "engine/pack/packed_scene.h"
#include "engine/parallel/worker_pool.h"

namespace raytracer {

/// A triangle in a cell.
template <typename T>
struct GridTriangle {
  T top;                   ///< how far it reaches towards the light
  std::uint32_t triangle;  ///< index into the triangles
};

/// The lines of a triangle's sides as the light sees them: a point's distance from line i, positive
/// on the inner side, is u_slopes[i] u + v_slopes[i] v + offsets[i].
template <typename T>
struct TriangleOutline {
  std::array<T, 3> u_slopes, v_slopes, offsets;
};

/// Empty if there are no triangles.
template <typename T>
struct TriangleGrid {
  std::array<Vec3, 3> axes{};  ///< two across the light's direction, and towards the light
  T u_low{};
  T v_low{};
  T cells_per_unit{};
  T noise{};  ///< what a distance from a line may be off by
  int columns = 0;
  int rows = 0;
  std::vector<std::uint32_t> begins;  ///< of each cell, row by row, and the end of the last
  LargeArray<GridTriangle<T>> entries;
  LargeArray<TriangleOutline<T>> outlines;  ///< by triangle
};

/// `towards` is a unit vector.
template <typename T>
TriangleGrid<T> build_triangle_grid(const Vec3& towards, std::span<const PackedTriangle> triangles,
                                    WorkerPool& pool);

extern template TriangleGrid<float> build_triangle_grid<float>(const Vec3&,
                                                               std::span<const PackedTriangle>,
                                                               WorkerPool&);
extern template TriangleGrid<double> build_triangle_grid<double>(const Vec3&,
                                                                 std::span<const PackedTriangle>,
                                                                 WorkerPool&);

}  // namespace raytracer
