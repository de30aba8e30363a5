// How many samples a pixel gets, and who says so.
#pragma once

#include <cstdint>
#include <optional>

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

/// The estimated error to which a contract is refined: target_rmse, if there is one, but 0.77 of it
/// where a square's spheres are small. Its lattice beats with the samples': estimates came down to
/// 0.77 of the error there, and 1 misses one of 135 targets.
std::optional<double> sought_rmse(const RenderSettings& settings, const Census& census);

/// How samples are chosen, with the reason.
Choice<Sampling> choose_sampling(const RenderSettings& settings, const Census& census);

}  // namespace raytracer
