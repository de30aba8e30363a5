// The scene as packets of rays read it, in their own precision.
//
// Everything that needs more than that precision (differences of coordinates, constants of each
// primitive as the eye or a light sees it) is computed once, in double, when the scene is made.
//
// Limits: the eye outside of every object. Then no ray ever starts inside one, because every
// surface is opaque, and packets model only what is seen from outside.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <tuple>
#include <vector>

#include "engine/finders/primitive_tree.h"
#include "engine/finders/screen_bins.h"
#include "engine/memory/page_allocator.h"
#include "engine/objects/packets.h"
#include "engine/pack/packed_scene.h"
#include "engine/parallel/worker_pool.h"
#include "engine/plan/geometry.h"
#include "engine/scene/features.h"

namespace raytracer {

/// A kind's primitives with what finds them.
template <class Kind_, typename T>
struct Geometry {
  using Kind = Kind_;
  using Layout = PacketLayout<Kind, T>;

  FinderRow finders{};
  std::size_t count = 0;
  LargeArray<typename Layout::Item> items;         ///< where rays or lists look at them
  ScreenBins bins;                                 ///< for rays from the eye
  ScreenMask mask;                                 ///< likewise, of a kind that finds its own parts
  PacketTree<typename Layout::Block> tree;         ///< empty where nothing needs it
  typename Layout::EyeView eye{};                  ///< as the eye sees them
  std::vector<typename Layout::LightView> lights;  ///< as each light sees them

  Finder finder(RayKind rays) const { return finder_of(finders, rays); }
};

/// Of every kind.
template <typename T>
struct Geometries {
  template <typename... Kind>
  using Tuple = std::tuple<Geometry<Kind, T>...>;
  ObjectKinds::In<Tuple> kinds;

  /// Calls visit(geometry) for the kinds that the scene has.
  template <typename Visit>
  void for_each(const Visit& visit) const {
    std::apply(
        [&](const auto&... geometry) { ((geometry.count > 0 ? visit(geometry) : void()), ...); },
        kinds);
  }
};

template <typename T>
struct PacketLight {
  std::size_t kind;  ///< its place in LightKinds
  LightRays rays;
  Triple<T> place;     ///< parallel: unit, towards the light; converging: its position
  Triple<T> emission;  ///< saturated, so that sums stay finite
  std::size_t index;   ///< among the lights
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
    x,  ///< as PrimitiveRow
    y,
    z,
    curvature,
    material,  ///< index into MaterialTable
    radius2,
    eye_c,
    row_size = 8,
  };
  LargeArray<T> values;

  const T* row(std::size_t id) const { return values.data() + row_size * id; }
  /// That value of all rows, to be looked up by `row_size` times the id.
  Column<const T> column(Value value) const { return Column<const T>(values).subspan(value); }

  void set(std::size_t id, const PrimitiveRow<T>& from, T material_index) {
    T* const to = values.data() + row_size * id;
    to[x] = from.place.x;
    to[y] = from.place.y;
    to[z] = from.place.z;
    to[curvature] = from.curvature;
    to[material] = material_index;
    to[radius2] = from.radius2;
    to[eye_c] = from.eye_c;
  }
};

template <typename T>
struct MaterialTable {
  Column<T> red, green, blue;
  Column<T> ambient;  ///< ka times the scene's
  Column<T> kd, ks, shininess, reflectivity;
  ColumnMemory<T> memory;
};

template <typename T>
struct PacketScene {
  View view;
  Triple<T> forward;  ///< the view's basis, in T
  Triple<T> right;
  Triple<T> up;
  Geometries<T> geometry;
  bool fetches_light_cells;  ///< before they are needed: the caches cannot hold them all
  bool has_flat;             ///< primitives without curvature
  bool has_own_normals;      ///< primitives whose kind computes them
  std::vector<PacketLight<T>> lights;
  PrimitiveTable<T> primitives;
  MaterialTable<T> materials;
  Triple<T> background;
  Shadows shadows;
  bool has_specular;
  std::int32_t uniform_shininess;  ///< the one integer exponent of all that is specular, or -1
  bool reflects;                   ///< whether any ray follows another
  int max_depth;                   ///< of rays that follow another
};

/// What no feature or finder asks for is left out. Uses the pool's threads.
template <typename T>
PacketScene<T> make_packet_scene(const PackedScene& scene, const Features& features,
                                 const FinderTable& finders, WorkerPool& pool);

extern template PacketScene<float> make_packet_scene<float>(const PackedScene&, const Features&,
                                                            const FinderTable&, WorkerPool&);
extern template PacketScene<double> make_packet_scene<double>(const PackedScene&, const Features&,
                                                              const FinderTable&, WorkerPool&);

}  // namespace raytracer
