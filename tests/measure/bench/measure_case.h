// One case: the project alone, then each peer in turn with it, round after round, and the pictures
// compared.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/measure/bench/cases.h"
#include "tests/measure/bench/image_difference.h"
#include "tests/measure/bench/project.h"
#include "tests/measure/peers/all_peers.h"

namespace raytracer::bench {

struct Effort {
  int rounds = 11;
  double seconds_per_case = 30;  ///< no new round after that, if there are enough
};

struct AloneRound {
  ProjectForecast forecast;
  ProjectTimes project;
};

/// The project and one peer, once each.
struct PeerRound {
  ProjectTimes project;
  peers::PeerTimes peer;
  std::string way;
};

struct PeerFigures {
  std::string name;
  std::optional<std::string> refusal{};    ///< why there is nothing else
  std::vector<std::string> differences{};  ///< that are known
  /// Peers apart: whoever comes after a program of seconds finds a processor that has slept and
  /// memory that was given back, and in rounds of all it was always the project.
  std::vector<PeerRound> rounds{};
  ImageDifference difference{};
  ByteImage picture{};
  ByteImage project_picture{};  ///< what it is compared with
};

struct CaseFigures {
  Case measured;
  int width_px = 0;
  int height_px = 0;
  int samples = 1;
  std::size_t document_bytes = 0;
  double covered = 0;  ///< share of the project's pixels that are not background
  std::vector<AloneRound> rounds{};
  std::vector<PeerFigures> peers{};
};

/// A first round of each warms up and does not count. A document's target or budget is replaced by
/// one sample.
CaseFigures measure_case(const Case& measured, const Effort& effort, const MachineCosts& costs,
                         const peers::Peers& all_peers, WorkerPool& pool);

}  // namespace raytracer::bench
