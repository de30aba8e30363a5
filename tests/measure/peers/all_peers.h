// The other renderers: to add one is a class of Peer and a line here.
#pragma once

#include <memory>
#include <vector>

#include "tests/measure/peers/peer.h"

namespace raytracer::peers {

using Peers = std::vector<std::unique_ptr<Peer>>;

/// On as many threads as `pool` has.
Peers all_peers(WorkerPool& pool);

}  // namespace raytracer::peers
