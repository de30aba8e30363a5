// How many samples a pixel gets, and who says so.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/plan/choice.h"
#include "engine/plan/scene_statistics.h"
#include "engine/scene/scene.h"

namespace raytracer {

enum class Sampling : std::uint8_t {
  fixed,     ///< as many as the scene says, one if it says nothing
  contract,  ///< ever more, until target_rmse or budget_ms ends it
};

Sampling sampling_of(const RenderSettings& settings);

/// Whether an image of 8 bits, too, is made from one of floats: that of a contract is refined, and
/// from one with a cover the colours have to be found.
inline bool needs_floats(const Scene& scene) {
  return sampling_of(scene.render) == Sampling::contract || channel_count(scene) == 4;
}

/// The samples per pixel of a contract's pilot pass, which tells where more are needed: few tell
/// little of what is smaller than a pixel.
int pilot_samples(const SceneStatistics& statistics);

/// Those of a render's first pass.
int first_samples(const RenderSettings& settings, const SceneStatistics& statistics);

/// The estimated error to which a contract is refined: target_rmse, if there is one, with a margin
/// where a lattice of objects is smaller than pixels, as it beats with the lattice of samples.
std::optional<double> refined_rmse(const RenderSettings& settings,
                                   const SceneStatistics& statistics);

/// How samples are chosen, with the reason.
Choice<Sampling> choose_sampling(const RenderSettings& settings, const SceneStatistics& statistics);

}  // namespace raytracer
