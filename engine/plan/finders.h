// Chooses the finders: one table [kind of object][kind of ray] -> finder.
//
// Nothing is built that no ray asks.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/finders/finder.h"
#include "engine/lights/light_places.h"
#include "engine/objects/objects.h"
#include "engine/plan/choice.h"
#include "engine/plan/scene_statistics.h"
#include "engine/scene/features.h"

namespace raytracer {

/// Which code traces the scene.
enum class Kernel : std::uint8_t {
  packets,      ///< packets of rays, of everything that is seen from outside
  single_rays,  ///< the reference, one ray at a time
};

/// A row for each kind of object.
using FinderTable = std::array<FinderRow, ObjectKinds::count>;

Choice<Kernel> choose_kernel(const SceneStatistics& statistics);

/// How points look for what hides the directions of soft lights from them.
struct SoftLightSearch {
  std::size_t directions = 0;  ///< that rays share, all lights together
  bool sweeps = false;         ///< whether all points of many tiles look at one after another
  double most_entries = 0;     ///< that grids of all directions may have: primitives times these
};

/// Whether some kind has so many primitives that sweeps take less time than grids.
bool has_enough_for_sweeps(const Features& features);

FinderTable choose_finders(const Features& features, const SceneStatistics& statistics,
                           Kernel kernel, const SoftLightSearch& search);

/// How some kinds of rays find one kind of object, in words.
struct FinderExplanation {
  std::string objects;  ///< "1,000 spheres"
  std::string rays;     ///< "from the eye", "to the distant lights", "followed"
  std::string finder;   ///< "light grids"
  std::string reason;
};

/// The table in words, without what is not there.
std::vector<FinderExplanation> explain_finders(const Features& features,
                                               const SceneStatistics& statistics, Kernel kernel,
                                               const FinderTable& table);

}  // namespace raytracer
