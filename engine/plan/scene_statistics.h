// How near, far and large the things of a scene are: what the choice of precision rests on.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "engine/math/tolerances.h"
#include "engine/objects/geometry_statistics.h"
#include "engine/pack/packed_scene.h"
#include "engine/parallel/worker_pool.h"
#include "engine/plan/shadow_reach.h"
#include "engine/scene/features.h"

namespace raytracer {

/// A light that shines along a flat object: rounding decides which of its points it reaches.
struct GrazingLight {
  std::size_t light;  ///< its place in the document
  std::size_t object;
  std::size_t kind;  ///< of the object
};

/// What of a point light tells how wide its shadows can be, in frame coordinates.
struct LampDistances {
  Vec3 place;
  double nearest;  ///< thing whose shadows are looked for from the points
  double bounded;  ///< the farthest point of anything that is
};

/// Lengths are in frame coordinates, distances from the eye.
struct SceneStatistics {
  std::array<GeometryStatistics, ObjectKinds::count> kinds;  ///< of each kind of object
  GeometryStatistics all;                                    ///< of all together
  double nearest = infinity;                                 ///< surface; 0 inside an object
  double farthest = 0;  ///< point of anything bounded, point lights included
  std::array<ShadowReach, ObjectKinds::count> shadows;  ///< of each kind of occluder
  /// How many times as far from a point light the farthest thing in view may be as the nearest
  /// thing whose shadows are looked for from the points: so much wider a shadow can be than its
  /// occluder.
  double shadow_spread = 1;
  std::vector<LampDistances> lamps;  ///< of each point light, in their order
  /// The least distance of a point light to a surface, as a share of the numbers from which it is
  /// computed.
  double light_clearance = infinity;
  /// By how much a reflection can magnify an error of direction, in what it changes of a pixel: a
  /// mirror of radius r spreads neighbouring rays 2 d / r times as far at a distance d, and shows
  /// what it mirrors only as bright as its reflectivity.
  double magnification = 1;
  double gap = infinity;  ///< as least_gap() says
  /// The sine of the lowest parallel light's elevation over a lattice; 1 without such.
  double lowest_light = 1;
  double lost = 0;         ///< primitives that the frame cannot carry
  double brightest = 0;    ///< i of a light where it is nearest to a surface, any channel
  double pixels = 0;       ///< of the image
  double pixel_angle = 0;  ///< radians, at the image's centre
  std::vector<GrazingLight> grazing;  ///< ten at most

  /// The nearest that an edge is seen: of a sphere on which the eye is, all but what is within a
  /// pixel of its horizon is farther.
  double nearest_edge() const { return all.clearance > 0 ? all.clearance : pixel_angle * farthest; }
};

/// `packed` is the scene's. `pool`: whose threads help with many primitives, if there is one; the
/// result is the same.
SceneStatistics gather_statistics(const Scene& scene, const PackedScene& packed,
                                  const Features& features, WorkerPool* pool);

/// The least radius that its corners' normals give something between corners; infinite where they
/// are all the same, and of what is thinner than single's rounding of its place: rays meet next to
/// nothing of it.
template <typename Primitive>
double smooth_radius(const PackedScene& packed, const Primitive& primitive) {
  const CornerValues* const values = packed.corner_values_of(primitive.id);
  if (values == nullptr || values->normals.empty()) return infinity;
  const std::array<Vec3, 3>& corners = corners_of(primitive);
  const double nearest = std::min({length(corners[0]), length(corners[1]), length(corners[2])});
  if (thickness(corners) < unit_roundoff<float> * nearest) return infinity;
  return least_radius(corners, values->normals_of(primitive.id.item));
}

/// Whether a kind's shadows under a point light are looked for from the points, of which an image
/// of so many pixels shows some, and not from the light.
template <class Kind>
bool is_sought_from_points(std::size_t count, double pixels) {
  if constexpr (Kind::search == Search::bounded)
    return count > Kind::few.to_lights &&
           pixels < Kind::pixels_for_cells * static_cast<double>(count);
  return Kind::search == Search::own && count > 0;
}

}  // namespace raytracer
