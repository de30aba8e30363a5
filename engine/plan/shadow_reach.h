// How much of the exactness of shadows, and of what rays from points meet, distances cost.
#pragma once

#include <array>

#include "engine/objects/objects.h"
#include "engine/pack/packed_scene.h"
#include "engine/parallel/worker_pool.h"
#include "engine/scene/features.h"

namespace raytracer {

struct SceneStatistics;

/// How far the shadows of a kind are thrown that are the less exact for it. Lengths are in frame
/// coordinates.
struct ShadowReach {
  double path = 0;  ///< no occluder is farther from the eye, nor from what a lattice shadows
  /// Of an occluder the distances from which its place is rounded over that of the nearest place,
  /// from the eye, at which its shadow's edge may be seen: the most. Likewise of what mirrors and
  /// lenses show.
  double growth = 0;
};

/// Of each kind. `statistics` has all but them.
std::array<ShadowReach, ObjectKinds::count> shadow_reaches(const PackedScene& packed,
                                                           const Features& features,
                                                           const SceneStatistics& statistics,
                                                           WorkerPool* pool);

}  // namespace raytracer
