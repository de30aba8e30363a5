// Which spheres may stand between a point and a point light.
//
// All rays to the light share their end, so a 2-D structure finds what they meet: a cube around
// the light, each of its faces a grid, into whose cells spheres are projected from the light.
// Entries lie cell by cell in columns of the kernel's precision, as in a distant light's grid.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/accel/columns.h"
#include "engine/pack/packed_scene.h"
#include "engine/parallel/worker_pool.h"

namespace raytracer {

/// A face of the cube is numbered 2 * axis, and one more on the negative side; its columns run
/// along the next axis (x to y to z to x), its rows along the one after that.
template <typename T>
struct PointGrid {
  int side = 0;                       ///< cells along a face's side
  bool is_far = false;                ///< as is_far_light() says
  std::vector<std::uint32_t> begins;  ///< of each cell, face by face and row by row, and the end
  /// The columns of a cell's spheres: as LitSphere; `id` is the primitive's.
  enum Column : std::size_t { x, y, z, radius2, nearest, id, column_count };
  CellColumns<T, column_count> spheres;  ///< of each cell, those nearest to the light first
};

/// `numbers` are those of the scene.
template <typename T>
PointGrid<T> build_point_grid(const Vec3& light, std::span<const PackedSphere> spheres,
                              const Numbering& numbers, WorkerPool& pool);

extern template PointGrid<float> build_point_grid<float>(const Vec3&, std::span<const PackedSphere>,
                                                         const Numbering&, WorkerPool&);
extern template PointGrid<double> build_point_grid<double>(const Vec3&,
                                                           std::span<const PackedSphere>,
                                                           const Numbering&, WorkerPool&);

}  // namespace raytracer
