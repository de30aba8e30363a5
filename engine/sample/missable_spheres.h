// Spheres smaller than a pixel, which samples can miss without a trace.
//
// What no sample met is in no difference between samples, so the error that it would leave is known
// from its size alone: where spheres cover the areas a_i of a pixel, together a, its n samples miss
// them all with at most about the probability exp(-n a / 2) (exp(-n a) if both lay anywhere), and
// leave out a_i of its light then.
//
// Limits: explicit spheres only. Those behind others count too.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/plan/frame.h"
#include "engine/scene/scene.h"

namespace raytracer {

class MissableSpheres {
 public:
  MissableSpheres(const Scene& scene, const Frame& frame);

  /// What missing them costs in this pixel, the sum over its values' squared errors, probably.
  /// Pixels are numbered as those of PixelSpreads.
  double error2(std::size_t pixel, int samples) const;

 private:
  struct Areas {
    float sum = 0;
    float sum_of_squares = 0;
  };

  std::vector<Areas> pixels_;
};

}  // namespace raytracer
