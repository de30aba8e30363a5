// What targets are worth on one random scene, against a picture of many more samples.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/engine.h"

namespace raytracer::published {

struct MeasuredTarget {
  double target = 0;
  double rmse = 0;                          ///< true
  std::optional<double> estimated_error{};  ///< what Render-Error says
  double samples_per_pixel = 0;             ///< mean
  Stop stop = Stop::target;
  bool is_known = true;  ///< whether the exact picture is exact enough to tell; else nothing is
};

struct MeasuredScene {
  std::uint64_t seed = 0;
  std::string summary{};
  int exact_samples = 0;
  double exact_error = 0;  ///< of the exact picture, by its own estimate: at most so much
  std::vector<MeasuredTarget> targets{};
};

/// The exact picture is in double precision and has ever four times the samples of the one before,
/// until its error is a sixth of the least target, or its samples would send more than about
/// `most_rays`; 60 it has in any case. Targets of less than three times its error are not rendered.
MeasuredScene measure_random_scene(std::uint64_t seed, const std::vector<double>& targets,
                                   double most_rays, WorkerPool& pool);

}  // namespace raytracer::published
