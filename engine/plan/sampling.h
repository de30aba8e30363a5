// How many samples a pixel gets, and who says so.
#pragma once

#include <cstdint>

#include "engine/plan/census.h"
#include "engine/plan/choice.h"
#include "engine/scene/scene.h"

namespace raytracer {

enum class Sampling : std::uint8_t {
  fixed,     ///< as many as the scene says, one without a word
  contract,  ///< ever more, until target_rmse or budget_ms ends it
};

Sampling sampling_of(const RenderSettings& settings);

/// The samples per pixel by which a contract tells where more are needed: few tell little of what
/// is smaller than a pixel.
int probing_samples(const Census& census);

/// Those of a render's first pass.
int first_samples(const RenderSettings& settings, const Census& census);

/// How samples are chosen, with the reason.
Choice<Sampling> choose_sampling(const RenderSettings& settings);

}  // namespace raytracer
