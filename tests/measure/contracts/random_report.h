// What is said of targets on many random scenes: needs no renderer.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/measure/contracts/random_measure.h"

namespace raytracer::published {

/// Of one target. Estimates are judged where the error is at least twice the exact picture's, and
/// not that of a flat picture's rounding.
struct TargetTally {
  std::size_t count = 0;  ///< of those that are known
  std::size_t kept_count = 0;
  std::size_t judged_count = 0;
  std::size_t within_2_count = 0;    ///< of those judged
  std::size_t within_2_5_count = 0;  ///< of those judged
  std::size_t below_half_count = 0;  ///< of those judged
  double least_ratio = 0;            ///< of an estimate to the true error; 0 without any
  double most_ratio = 0;
};

/// The `index`th target of every scene.
TargetTally tally(const std::vector<MeasuredScene>& scenes, std::size_t index);

/// Whether so many of all are as many as they have to be.
bool is_enough(std::size_t kept_count, std::size_t count);

/// Markdown: a row for each target, the estimates below half of the error, and every miss.
std::string report_random(const std::vector<MeasuredScene>& scenes);

}  // namespace raytracer::published
