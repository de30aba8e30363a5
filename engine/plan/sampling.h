// How many samples a pixel gets, and who says so.
#pragma once

#include <cstdint>

#include "engine/plan/choice.h"
#include "engine/scene/scene.h"

namespace raytracer {

enum class Sampling : std::uint8_t {
  fixed,     ///< as many as the scene says, one without a word
  contract,  ///< ever more, until target_rmse or budget_ms ends it
};

Sampling sampling_of(const RenderSettings& settings);

/// The same with its reason.
Choice<Sampling> choose_sampling(const RenderSettings& settings);

}  // namespace raytracer
