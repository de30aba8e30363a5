// Spheres smaller than a pixel, which samples can miss without a trace.
//
// What no sample met is in no difference between samples, so the error that it would leave is known
// from its size alone: where the spheres of a part cover the area a (in pixels, each a_i), n
// samples per pixel miss them all with at most about the probability exp(-n a / 2) (exp(-n a) if
// both lay anywhere), and leave out a_i of a pixel's light then.
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

  /// What missing them costs in this part, the sum over its values' squared errors, probably. Parts
  /// are numbered as those of PartErrors.
  double error2(std::size_t part, int samples) const;

 private:
  struct Areas {
    double sum = 0;
    double sum_of_squares = 0;
  };

  std::vector<Areas> parts_;
};

}  // namespace raytracer
