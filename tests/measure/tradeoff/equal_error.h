// What the same error costs the project, Embree on a regular grid and POV-Ray with the best of its
// anti-aliasing, on one scene.
//
// The setting of each peer is the cheapest of a sweep whose true error is at most the target; the
// project is asked for the target. Then all run in turn, round after round. Errors are from the
// project's own picture of thousands of samples: a peer's shading that differs counts as error, and
// where that keeps it from a target, the least error that it came to is given.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/measure/peers/embree_peer.h"
#include "tests/measure/peers/povray_peer.h"
#include "tests/measure/tradeoff/sweep.h"

namespace raytracer::published {

struct EqualErrorCase {
  std::string scene{};     ///< its name
  std::string document{};  ///< black shadows and the linear transfer, which all draw
};

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
  std::vector<double> trace_ms{};       ///< the project's, by round
  std::optional<PeerFigures> embree{};  ///< absent where no setting is that good
  std::optional<PeerFigures> povray{};
};

struct EqualErrorFigures {
  std::string scene{};
  int exact_samples = 0;
  double exact_error = 0;  ///< estimated; see exact_picture.h
  Sweep with_samples{};    ///< the project, samples fixed
  Sweep with_target{};     ///< the project, by the targets
  Sweep embree{};
  Sweep povray{};
  double embree_floor = 0;  ///< with very many samples; 0 where all targets were reached
  std::vector<TargetFigures> targets{};
};

struct ImageSize {
  int width_px = 175;
  int height_px = 125;
};

EqualErrorFigures measure_equal_error(const EqualErrorCase& measured, ImageSize size,
                                      const EqualErrorEffort& effort, WorkerPool& pool,
                                      bench::EmbreePeer& embree, bench::PovrayPeer& povray);

/// The median of the rounds' ratios of `peer` to the project.
double median_ratio(const TargetFigures& figures, const PeerFigures& peer);

}  // namespace raytracer::published
