#include "tests/measure/peers/all_peers.h"

#include "tests/measure/peers/embree_peer.h"
#include "tests/measure/peers/povray_peer.h"
#include "tests/measure/peers/tachyon_peer.h"

namespace raytracer::peers {

Peers all_peers(WorkerPool& pool) {
  Peers peers;
  peers.push_back(std::make_unique<EmbreePeer>(pool));
  peers.push_back(std::make_unique<PovrayPeer>(pool.thread_count()));
  peers.push_back(std::make_unique<TachyonPeer>(pool.thread_count()));
  return peers;
}

}  // namespace raytracer::peers
