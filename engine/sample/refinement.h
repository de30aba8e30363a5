// Which pixels of an image get more samples, and how many.
//
// The sum of squared errors is brought to a bound by the fewest samples if all pixels' errors per
// sample are equal (Lagrange): where a pixel's errors fall as c n^-3/2, c being its error
// coefficient, n grows as c^2/5, and one factor common to all pixels tells each its number. What
// that brings is planned by a faster fall where enough samples told of an error.
//
// New samples replace the old ones, as even spread is worth more than their sum. Pixels alike in
// both samples and error coefficient, an error class, are decided together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/plan/scene_statistics.h"
#include "engine/scene/limits.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// The most samples per pixel that the limits grant a contract on this scene, with those before
/// them, which are at most as many; at least 1.
int most_samples(const Scene& scene, const Limits& limits);

/// The samples per pixel of the pilot pass, after which pixels are chosen, of at most so many: as
/// many as pilot_samples() says, or fewer in half buffers, or a single one.
int choose_pilot_samples(const SceneStatistics& statistics, int most_samples);

/// A pixel that more samples would do good.
struct PixelError {
  std::uint32_t pixel;
  int samples;   ///< that it has, at least 4
  float error2;  ///< above 0
};

/// A pixel and the samples that it gets.
struct PixelSamples {
  std::uint32_t pixel;
  int samples;
};

/// What a refinement is for, and what it may cost.
struct RefinementGoal {
  double error2;     ///< to which the pixels' sum is to fall; 0 for the least that can be reached
  double samples;    ///< at most so many in all; infinite without a limit
  int most_samples;  ///< of any pixel, at least 4
};

/// Those of the pixels that are to be refined, in their order. None if the goal is reached, or
/// nothing can be done for it.
std::vector<PixelSamples> choose_samples(std::span<const PixelError> pixels,
                                         const RefinementGoal& goal);

}  // namespace raytracer
