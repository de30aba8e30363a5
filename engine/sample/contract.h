// How many samples the next pass takes: the controller of the accuracy and the time contract.
//
// Passes of growing sample counts are rendered until the bound is kept. The error of a pass is
// estimated from its difference to the one before, which had at most half as many samples: with
// the error falling at least as the square root of the count, the later pass is off by less than
// the difference divided by (sqrt(ratio) - 1).
#pragma once

#include <optional>

#include "engine/image/image.h"
#include "engine/scene/limits.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// What one finished pass tells about the next.
struct PassReport {
  int samples = 0;              ///< per pixel
  double pass_ms = 0;           ///< of this pass alone
  double elapsed_ms = 0;        ///< since tracing began
  std::optional<double> error;  ///< estimated; nothing after the first pass
};

/// The samples per pixel of the first pass of a contract.
inline constexpr int first_pass_samples = 1;

/// The next pass's samples per pixel; nothing if the contract is kept as well as it can be.
/// `most_samples` bounds them.
std::optional<int> next_pass(const RenderSettings& settings, const PassReport& last,
                             int most_samples);

/// The most samples per pixel that the limits grant a contract on this scene; at least 1.
int most_samples(const Scene& scene, const Limits& limits);

/// The estimated error of `later`, which took `ratio` (above 1) times the samples of `earlier`.
double estimate_error(const Image& earlier, const Image& later, double ratio);

}  // namespace raytracer
