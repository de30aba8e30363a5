// Embree and POV-Ray with ever more samples: what each setting takes and how far off it is.
#pragma once

#include <string>
#include <vector>

#include "tests/measure/peers/embree_peer.h"
#include "tests/measure/peers/povray_peer.h"
#include "tests/measure/tradeoff/sweep.h"

namespace raytracer::published {

/// A regular grid of side x side samples in every pixel, by its number 1, 2, 3 ... The time is that
/// of the fastest way to hand rays over, of one that was the fastest on a small grid for large
/// ones.
struct EmbreeSweep {
  Sweep points{};         ///< point i has the side i + 1
  double floor_rmse = 0;  ///< with 48 x 48 samples, where the target was not reached; else 0
};

/// Until the error is at most `least_target`, and on to the next grid that fills whole packets.
EmbreeSweep sweep_embree(bench::EmbreePeer& embree, bench::EmbreeWorld& world, const Image& exact,
                         double least_target);

/// Its anti-aliasing methods 1 and 2, several thresholds, ever more depth while that pays: its
/// method 1 has a limit of its own, which more depth does not take away.
struct PovraySweep {
  std::vector<bench::PovrayAntialiasing> settings{};  ///< of each point
  Sweep points{};
  double floor_rmse = 0;  ///< with 40 x 40 samples, where the target was not reached; else 0
};

/// As its command line has it.
std::string name_of(const bench::PovrayAntialiasing& setting);

/// The scene must be set. `exact` is without ambient light, as its pictures are.
PovraySweep sweep_povray(const bench::PovrayPeer& povray, const Image& exact, double least_target);

}  // namespace raytracer::published
