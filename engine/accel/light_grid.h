// Which spheres may stand between a point and a light.
//
// All rays to one light share a direction (distant) or an end (point), so again a 2-D structure
// finds what they meet. A distant light's is a grid on the plane across its direction, in which
// spheres are discs; a point light's is a grid on each face of a cube around it. Entries lie cell
// by cell in columns of the kernel's precision, ready to be tested many at a time.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/accel/columns.h"
#include "engine/pack/packed_scene.h"
#include "engine/parallel/worker_pool.h"

namespace raytracer {

/// For a distant light.
template <typename T>
struct DistantGrid {
  std::array<Vec3, 3> axes;  ///< two across the light's direction, and towards the light
  T u_low;
  T v_low;
  T cells_per_unit;
  int columns = 0;
  int rows = 0;
  std::vector<std::uint32_t> begins;  ///< of each cell, row by row, and the end of the last
  /// A cell of so few discs is not in order: a packet or two test them all.
  static constexpr std::size_t few = 32;
  /// The columns of a cell's discs: `w` is how far the centre is towards the light, `id` the
  /// primitive's.
  enum Column : std::size_t { u, v, w, radius2, id, column_count };
  /// Of each other cell's discs, those nearest to the light first.
  CellColumns<T, column_count> discs;
};

/// `numbers` are those of the scene. `towards` is a unit vector.
template <typename T>
DistantGrid<T> build_distant_grid(const Vec3& towards, std::span<const PackedSphere> spheres,
                                  const Numbering& numbers, WorkerPool& pool);

extern template DistantGrid<float> build_distant_grid<float>(const Vec3&,
                                                             std::span<const PackedSphere>,
                                                             const Numbering&, WorkerPool&);
extern template DistantGrid<double> build_distant_grid<double>(const Vec3&,
                                                               std::span<const PackedSphere>,
                                                               const Numbering&, WorkerPool&);

}  // namespace raytracer
