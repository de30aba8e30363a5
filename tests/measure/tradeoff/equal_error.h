// What the same error costs the project and each peer with the best of its anti-aliasing, on one
// scene.
//
// The setting of each peer is the cheapest of a sweep whose true error is at most the target; the
// project is asked for the target. Then all run in turn, round after round. Errors are from the
// project's own picture of hundreds to thousands of samples: a peer's shading that differs counts
// as error, and where that keeps it from a target, the least error that it came to is given.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/measure/peers/all_peers.h"
#include "tests/measure/scenes/named_scene.h"
#include "tests/measure/tradeoff/sweep.h"

namespace raytracer::published {

struct EqualErrorEffort {
  std::vector<double> targets{};  ///< falling
  int exact_samples = 12'288;
  int rounds = 5;
  double seconds = 4;  ///< no new round of a target after that, if there were three
};

/// A peer's cheapest setting for a target.
struct PeerFigures {
  std::string setting{};
  double rmse = 0;
  std::vector<double> trace_ms{};  ///< of the first rounds, fewer than all where it is slow
};

struct TargetFigures {
  double target = 0;
  double rmse = 0;                          ///< the project's, true
  std::optional<double> estimated_error{};  ///< as it said itself
  double samples_per_pixel = 0;
  std::vector<double> trace_ms{};  ///< the project's, by round
  /// By peer; absent where it cannot draw the scene, or no setting is that good.
  std::vector<std::optional<PeerFigures>> peers{};
};

struct PeerOutcome {
  std::string name{};
  std::optional<std::string> refusal{};    ///< why it cannot draw the scene
  std::vector<std::string> differences{};  ///< that are known
  Sweep sweep{};
};

struct EqualErrorFigures {
  std::string scene{};
  int width_px = 0;
  int height_px = 0;
  int exact_samples = 0;
  double exact_error = 0;  ///< estimated; see exact_picture.h
  Sweep with_samples{};    ///< the project, samples fixed
  Sweep with_target{};     ///< the project, by the targets
  std::vector<PeerOutcome> peers{};
  std::vector<TargetFigures> targets{};
};

/// With as many pixels as 175 x 125, in the proportions of the document.
EqualErrorFigures measure_equal_error(const measure::NamedScene& measured,
                                      const EqualErrorEffort& effort, const peers::Peers& all_peers,
                                      WorkerPool& pool);

/// The median of the rounds' ratios of `peer` to the project.
double median_ratio(const TargetFigures& figures, const PeerFigures& peer);

}  // namespace raytracer::published
