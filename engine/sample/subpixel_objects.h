// Objects smaller than a pixel, which samples can miss without a trace.
//
// What no sample met is in no difference between samples, so the error that it would leave is known
// from its size alone: where such objects cover the areas a_i of a pixel, together a, its n samples
// miss them all with at most about the probability exp(-n a / 2) (exp(-n a) if both lay anywhere),
// and leave out a_i of its light then.
//
// Limits: kinds that tell their subpixel pieces; lattices do not. Those behind others count too.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/pack/packed_scene.h"

namespace raytracer {

class SubpixelObjects {
 public:
  /// `channels`: of the image.
  SubpixelObjects(const PackedScene& scene, int channels);

  /// What missing them costs in this pixel, the sum over its values' squared errors, probably.
  /// Pixels are numbered as those of PixelSpreads.
  double error2(std::size_t pixel, int samples) const;

 private:
  struct Areas {
    float sum = 0;
    float sum_of_squares = 0;
  };

  std::vector<Areas> pixels_;
  int channels_;
};

}  // namespace raytracer
