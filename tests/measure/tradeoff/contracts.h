// Whether the asked error is kept, and how true the estimate is, on many scenes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/engine.h"
#include "tests/measure/scenes/named_scene.h"

namespace raytracer::published {

struct KeptTarget {
  double target = 0;
  double rmse = 0;                          ///< true
  std::optional<double> estimated_error{};  ///< what Render-Error says
  double samples_per_pixel = 0;             ///< mean
  Stop stop = Stop::target;
  double trace_ms = 0;  ///< once
};

struct ContractFigures {
  std::string scene{};
  int width_px = 0;
  int height_px = 0;
  int exact_samples = 0;
  double exact_error = 0;  ///< estimated; see exact_picture.h
  std::vector<KeptTarget> targets{};
};

/// At 175 x 125; at a half or a quarter of that where the exact picture would take longer than
/// `most_seconds`, or with four or sixteen times the samples where its error is not a fourth of the
/// least target. Nothing where the exact picture would take too long at any size. `targets` fall.
std::optional<ContractFigures> measure_contracts(const measure::NamedScene& measured,
                                                 const std::vector<double>& targets,
                                                 int exact_samples, double most_seconds,
                                                 WorkerPool& pool);

/// Estimates are judged where the error is at least three times that of the exact picture.
struct ContractVerdict {
  std::size_t count = 0;
  std::size_t kept_count = 0;
  std::size_t judged_count = 0;  ///< estimates
  std::size_t near_count = 0;    ///< of these within a factor of two of the true error
  double least_ratio = 0;        ///< of an estimate to the true error; 0 for none
};

ContractVerdict judge(const std::vector<ContractFigures>& figures);

}  // namespace raytracer::published
