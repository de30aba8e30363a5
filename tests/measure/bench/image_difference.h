// How different two pictures are.
#pragma once

#include "engine/engine.h"

namespace raytracer::bench {

struct ImageDifference {
  double rmse = 0;       ///< root mean square over pixels and channels, which are from 0 to 1
  double share_off = 0;  ///< of pixels with a channel off by more than two levels of 255
};

/// Throws std::runtime_error if the sizes differ.
ImageDifference compare_images(const ByteImage& a, const ByteImage& b);

ByteImage rounded(const Image& image);

/// The share of pixels that are not of the colour `background`.
double covered_share(const ByteImage& image, const Rgb& background, Transfer transfer);

}  // namespace raytracer::bench
