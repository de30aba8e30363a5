// Without Embree: no peer is built.
#include "tests/measure/extremes/peers.h"

namespace raytracer::extremes {

struct Peers::Programs {};

Peers::Peers(WorkerPool& pool) : pool_(pool) {}
Peers::~Peers() = default;

std::string Peers::povray(const Scene& /*scene*/, const ExactImage& /*exact*/) { return "-"; }
std::string Peers::embree(const Scene& /*scene*/, const ExactImage& /*exact*/) { return "-"; }

}  // namespace raytracer::extremes
