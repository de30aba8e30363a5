// One case: the project and each peer in turn, round after round, and the pictures compared.
#pragma once

#include <optional>
#include <vector>

#include "tests/measure/bench/cases.h"
#include "tests/measure/bench/image_difference.h"
#include "tests/measure/bench/project_peer.h"
#include "tests/measure/peers/embree_peer.h"
#include "tests/measure/peers/povray_peer.h"

namespace raytracer::bench {

struct Effort {
  int rounds = 11;
  double seconds_per_case = 30;  ///< no new round after that, if there are enough
};

/// A null peer takes no part.
struct Peers {
  WorkerPool& pool;
  MachineCosts costs;
  EmbreePeer* embree;
  PovrayPeer* povray;
};

struct Round {
  ProjectForecast forecast;
  ProjectTimes project;
  std::optional<EmbreeTimes> embree;
  std::optional<PovrayTimes> povray;
};

/// Empty where a peer took no part.
struct Pictures {
  ByteImage project;
  ByteImage project_without_ambient;  ///< what POV-Ray's picture is compared with
  ByteImage embree;
  ByteImage povray;
};

struct CaseFigures {
  Case measured;
  std::vector<Round> rounds{};  ///< with Embree
  /// With POV-Ray, after the others: whoever comes after its process of seconds finds a processor
  /// that has slept and memory that was given back, and in rounds of three it was always the
  /// project.
  std::vector<Round> povray_rounds{};
  Pictures pictures{};
  std::size_t document_bytes = 0;
  double covered = 0;  ///< share of the project's pixels that are not background
  std::optional<ImageDifference> embree_off{};
  std::optional<ImageDifference> povray_off{};
};

/// A first round warms up and does not count.
CaseFigures measure(const Case& measured, const Effort& effort, const Peers& peers);

}  // namespace raytracer::bench
