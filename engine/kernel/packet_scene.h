// The scene as packets of rays read it, in their own precision.
//
// Everything that needs more than that precision (differences of coordinates, constants of each
// primitive as the eye or a light sees it) is computed once, in double, when the scene is made.
//
// Limits: the eye outside of every object. Then rays start inside of one only where a surface lets
// them through, and packets of all others model only what is seen from outside.
#pragma once

#include <tuple>
#include <vector>

#include "engine/kernel/corner_row.h"
#include "engine/kernel/exact_scene.h"
#include "engine/lights/packet_light.h"
#include "engine/materials/material_row.h"
#include "engine/objects/geometry.h"
#include "engine/objects/packets.h"
#include "engine/pack/packed_scene.h"
#include "engine/parallel/worker_pool.h"
#include "engine/plan/finders.h"
#include "engine/scene/features.h"

namespace raytracer {

/// The geometry of every kind.
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

/// A light that is larger than a point.
template <typename T>
struct PacketSoftLight {
  PacketLight<T> light;  ///< its middle; of a sky only the emission counts
  LightShape shape;
  T size;  ///< as PackedLight has it
  PlaceNumbers numbers;
  std::size_t first_told;  ///< of those that ledgers tell of
  /// Its places as SoftLight has them; where rays share directions, these.
  std::vector<Triple<T>> places;
  std::vector<PacketLight<T>> directions;
  std::vector<PacketLight<T>> opposites;  ///< of a sky's directions
};

template <typename T>
struct PacketScene {
  View view;
  Triple<T> forward;  ///< the view's basis, in T
  Triple<T> right;
  Triple<T> up;
  Geometries<T> geometry;
  /// Of kinds of which some let light through and some do not, as rays to lights find them: what
  /// hides a light is known at once from the latter, and only the former are followed through.
  Geometries<T> opaque;
  Geometries<T> transmitting;
  bool fetches_light_cells;            ///< before they are needed: the caches cannot hold them all
  bool has_flat;                       ///< primitives without curvature
  bool has_own_normals;                ///< primitives whose kind computes them
  std::vector<PacketLight<T>> lights;  ///< that are points
  std::vector<PacketSoftLight<T>> soft_lights;
  int light_sets;                    ///< of places on these
  int sets_to_be_sure;               ///< as LightSampling has it
  std::size_t told_places;           ///< of all soft lights, that ledgers tell of
  PrimitiveRows<T> primitives;       ///< by their numbers
  LargeArray<CornerRow<T>> corners;  ///< of primitives whose corners tell normals or colours
  PacketMaterials<T> materials;
  Triple<T> background;
  Shadows shadows;
  bool transmits;          ///< some surface lets rays through
  int max_depth;           ///< of rays that follow another; 0 if none does
  bool sweeps_soft_light;  ///< some of what hides its directions is found by sweeps
  ExactScene exact;
};

/// What no feature or finder asks for is left out. Uses the pool's threads. Its `exact` has no
/// scene.
template <typename T>
PacketScene<T> make_packet_scene(const PackedScene& scene, const Features& features,
                                 const FinderTable& finders, WorkerPool& pool);

extern template PacketScene<float> make_packet_scene<float>(const PackedScene&, const Features&,
                                                            const FinderTable&, WorkerPool&);
extern template PacketScene<double> make_packet_scene<double>(const PackedScene&, const Features&,
                                                              const FinderTable&, WorkerPool&);

}  // namespace raytracer
