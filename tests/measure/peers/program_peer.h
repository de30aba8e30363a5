// What peers have in common that are programs of their own, run anew for each picture.
#pragma once

#include <string>
#include <vector>

#include "tests/measure/peers/peer.h"

namespace raytracer::peers {

class ProgramPeer : public Peer {
 public:
  bool is_program() const override { return true; }
  bool omits_ambient(const Scene& scene) const override;
  std::vector<std::string> differences(const Scene& scene) const override;
};

}  // namespace raytracer::peers
