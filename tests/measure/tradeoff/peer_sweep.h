// A peer with ever more samples: what each setting takes and how far off it is.
#pragma once

#include <vector>

#include "tests/measure/peers/peer.h"
#include "tests/measure/tradeoff/sweep.h"

namespace raytracer::published {

struct PeerSweep {
  std::vector<peers::Setting> settings{};  ///< of each point
  Sweep points{};
};

/// Its picture as stored, with the time of `setting`; of what is no program once it is warm.
peers::Drawing draw(const peers::Peer& peer, const peers::Setting& setting, Transfer transfer);

/// Up each of its ladders while that pays: until the error is at most `least_target`, or what is
/// faster reaches that. The scene must be set; `exact` is of what the peer draws.
PeerSweep sweep_peer(peers::Peer& peer, const Image& exact, Transfer transfer, double least_target);

}  // namespace raytracer::published
