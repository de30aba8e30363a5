// How different two pictures are, in 8-bit levels.
#pragma once

#include "engine/engine.h"

namespace raytracer::bench {

struct ImageDifference {
  double share_off = 0;    ///< of pixels with a channel off by more than two levels
  double mean_levels = 0;  ///< mean absolute difference of a channel, in levels
};

/// Throws std::runtime_error if the sizes differ.
ImageDifference compare_images(const ByteImage& a, const ByteImage& b);

/// The share of pixels that are not of the colour `background`.
double covered_share(const ByteImage& image, const Rgb& background);

}  // namespace raytracer::bench
