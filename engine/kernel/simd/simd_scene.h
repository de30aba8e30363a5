// The scene as the SIMD kernels read it, in their own precision.
//
// Everything that needs more than that precision (differences of coordinates, the constant C of
// each sphere as the eye sees it) is computed once, in double, when the scene is packed.
//
// Limits: the eye outside of every sphere. Then no ray ever starts inside one, because every
// surface is opaque, and the kernels model only spheres seen from outside.
#pragma once

#include <hwy/aligned_allocator.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "engine/accel/light_grid.h"
#include "engine/accel/point_grid.h"
#include "engine/accel/screen_bins.h"
#include "engine/accel/triangle_grid.h"
#include "engine/kernel/simd/simd_tree.h"
#include "engine/math/block.h"
#include "engine/pack/packed_scene.h"
#include "engine/parallel/worker_pool.h"
#include "engine/plan/features.h"
#include "engine/plan/structures.h"

namespace raytracer {

/// Three coordinates in a kernel's precision.
template <typename T>
struct Triple {
  T x;
  T y;
  T z;
};

/// A sphere; `id` numbers the scene's primitives in the document's order.
template <typename T>
struct SimdSphere {
  Triple<T> center;
  T radius2;
  T id;  ///< numbers of primitives are kept as T: they are small
};

template <typename T>
struct SimdPlane {
  Triple<T> normal;  ///< unit
  T height;          ///< normal . (point - eye)
  T id;
};

template <typename T>
struct SimdTriangle {
  std::array<Triple<T>, 3> corners;
  SimdPlane<T> plane;  ///< through its corners; the id is the triangle's
};

/// The planes through the eye and the sides of a triangle: their unit normals, towards the
/// triangle. Those of triangles that share a side are opposite to the bit.
template <typename T>
using TriangleCone = std::array<Triple<T>, 3>;

/// A square of spheres in units of its cells (one cell is a sphere's diameter), its spanning axes
/// first and last, the axis across it in the middle. Cells have integer coordinates relative to
/// the cell in which the eye would stand.
template <typename T>
struct SimdSquare {
  std::array<int, 3> axes;  ///< of x, y, z: first, across, second
  Triple<T> eye;            ///< relative to the centre of the eye's cell
  T low_first;              ///< the cells' coordinates
  T high_first;
  T low_second;
  T high_second;
  T cells_per_unit;  ///< 1 / (2 radius)
  T unit_per_cell;
  T id;
  T inner_low_first = 0;  ///< where is_plainly_lit: cells with every neighbour that a stencil names
  T inner_high_first = 0;
  T inner_low_second = 0;
  T inner_high_second = 0;
  T clear_above =
      0;  ///< likewise: heights, in cells, from which no ray to a light meets the square
  T clear_below = 0;
};

/// A neighbour, by its offset in cells.
template <typename T>
struct StencilCell {
  T first;
  T second;
  T distance2;  ///< of the offset
  T forward;    ///< its part along the light's direction
};

/// For one light and one square: the neighbours that can shadow a sphere.
template <typename T>
struct Stencil {
  std::vector<StencilCell<T>> cells;
  T reach;        ///< the largest coordinate of an offset
  bool suffices;  ///< false where the light is so low that only a walk will do
};

/// A sphere as a distant light sees it.
template <typename T>
struct LightDisc {
  T u;  ///< across the light's direction
  T v;
  T w;  ///< towards the light
  T radius2;
  T id;
};

/// A sphere as a point light sees it: LitSphere.
template <typename T>
struct LightBall {
  Triple<T> center;
  T radius2;
  T nearest;
  T id;
};

template <typename T>
struct SimdLight {
  bool is_distant;
  Triple<T> place;                   ///< distant: unit, towards the light; point: its position
  Triple<T> emission;                ///< saturated, so that sums stay finite
  std::vector<Stencil<T>> stencils;  ///< distant: one for each square
  std::array<Triple<T>, 2> across;   ///< distant: unit, across its direction
  std::vector<LightDisc<T>> discs;   ///< where is_plainly_lit: of all spheres
  std::vector<LightBall<T>> balls;   ///< point: of all spheres, where there are few ...
  bool is_far;                       ///< ... as is_far_light() says of them
  std::vector<T> plane_sides;        ///< point: of each plane 1 or -1, 0 if the light is in it
  DistantGrid<T> grid;               ///< distant: over the spheres, where there are many
  PointGrid<T> point_grid;           ///< point: likewise
  TriangleGrid<T> triangle_grid;     ///< distant, if its rays do not go through the tree
};

/// A column of values that SIMD code gathers from.
template <typename T>
using Column = std::span<T>;

/// The memory of a table's columns, all in one: to ask for each takes as long as to fill in those
/// of a small scene. It can be moved and not copied, as the columns are where it is.
template <typename T>
struct ColumnMemory : LargeArray<T> {
  ColumnMemory() = default;
  ColumnMemory(ColumnMemory&&) noexcept = default;
  ColumnMemory& operator=(ColumnMemory&&) noexcept = default;

  /// Gives each column so many rows, which are not set.
  void share_out(std::size_t row_count, std::initializer_list<Column<T>*> columns) {
    this->resize(row_count * columns.size());
    std::size_t begin = 0;
    for (Column<T>* const column : columns) {
      *column = Column<T>(*this).subspan(begin, row_count);
      begin += row_count;
    }
  }
};

/// What rays from the eye and all hits need of each primitive, in rows by id: neighbouring rays
/// meet primitives that lie far from each other in memory, and a row is in one or two cache lines.
template <typename T>
struct PrimitiveTable {
  enum Value : std::size_t {
    x,  ///< of a sphere's centre; of the opposite of a plane's normal
    y,
    z,
    curvature,  ///< 1 / radius; 0 for a plane
    material,   ///< index into MaterialTable
    radius2,    ///< a sphere's
    eye_c,      ///< a sphere's |center|^2 - radius^2
    row_size = 8,
  };
  LargeArray<T> values;

  const T* row(std::size_t id) const { return values.data() + row_size * id; }
  /// That value of all rows, to be looked up by `row_size` times the id.
  Column<const T> column(Value value) const { return Column<const T>(values).subspan(value); }
};

template <typename T>
struct MaterialTable {
  Column<T> red, green, blue;
  Column<T> ambient;  ///< ka times the scene's
  Column<T> kd, ks, shininess, reflectivity;
  ColumnMemory<T> memory;
};

template <typename T>
struct SimdScene {
  View view;
  Triple<T> forward;  ///< the view's basis, in T
  Triple<T> right;
  Triple<T> up;
  bool has_spheres;
  std::vector<SimdSphere<T>>
      spheres;               ///< where rays but those from the eye and to point lights try each
  ScreenBins bins;           ///< of the spheres, for rays from the eye
  bool has_sphere_bins;      ///< else rays from the eye find spheres by the tree
  bool has_light_grids;      ///< for shadows of spheres; else their tree, or each
  bool fetches_light_cells;  ///< before they are needed: the caches cannot hold them all
  std::vector<SimdSquare<T>> squares;
  std::vector<SimdPlane<T>> planes;
  SimdTree<SphereBlock<T>> sphere_tree;      ///< empty where nothing needs it
  SimdTree<TriangleBlock<T>> triangle_tree;  ///< empty where nothing needs it
  bool has_triangles;
  bool has_triangle_bins;
  LargeArray<SimdTriangle<T>> triangles;  ///< where they are found by bins or grids
  LargeArray<TriangleCone<T>> eye_cones;  ///< where they are found by bins
  std::vector<SimdLight<T>> lights;
  PrimitiveTable<T> primitives;
  MaterialTable<T> materials;
  Triple<T> background;
  Shadows shadows;
  bool is_plainly_lit;  ///< only by distant lights, past a few spheres and stencils
  bool has_specular;
  std::int32_t uniform_shininess;  ///< the one integer exponent of all that is specular, or -1
  bool reflects;                   ///< whether any ray follows another
  int max_depth;                   ///< of rays that follow another
};

/// What no feature or structure asks for is left out. Uses the pool's threads.
template <typename T>
SimdScene<T> make_simd_scene(const PackedScene& scene, const Features& features,
                             const Structures& structures, WorkerPool& pool);

extern template SimdScene<float> make_simd_scene<float>(const PackedScene&, const Features&,
                                                        const Structures&, WorkerPool&);
extern template SimdScene<double> make_simd_scene<double>(const PackedScene&, const Features&,
                                                          const Structures&, WorkerPool&);

}  // namespace raytracer
