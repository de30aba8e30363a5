// Objects smaller than a pixel, which samples can miss without a trace.
//
// What no sample met is in no difference between samples, so the error that it would leave is known
// from its size: where such objects have the areas a_i in a pixel, together a, they cover about
// c = 1 - exp(-a) of it, as some hide others, and show c / a of their areas. Its n samples miss
// them all with at most about the probability exp(-n c / 2) (exp(-n c) if both lay anywhere), and
// leave out what they show of its light then.
//
// How much that light differs from what is around it, other pixels tell whose samples met some.
//
// Limits: kinds that tell their subpixel pieces; lattices do not. One contrast for all of an
// image's: a few bright ones among many dim are told as dim.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/image/pixel_spreads.h"
#include "engine/pack/packed_scene.h"

namespace raytracer {

class SubpixelObjects {
 public:
  /// `channels`: of the image.
  SubpixelObjects(const PackedScene& scene, int channels);

  /// Takes in what so many samples of each pixel tell of their contrast. Until then it is taken to
  /// be as that of black and white.
  void learn_contrast(const PixelSpreads& spreads, int samples);

  /// What missing them costs in this pixel, the sum over its values' squared errors in linear
  /// light, probably. Pixels are numbered as those of PixelSpreads.
  double error2(std::size_t pixel, int samples) const;

 private:
  struct Areas {
    float sum = 0;
    float sum_of_squares = 0;
  };

  std::vector<Areas> pixels_;
  double contrast2_;  ///< squared, the sum over the channels
};

}  // namespace raytracer
