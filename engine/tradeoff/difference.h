// How far one image is from another, in the three figures that are published.
#pragma once

#include "engine/image/image.h"

namespace raytracer {

struct Difference {
  double rmse = 0;       ///< root mean square over all pixels and channels
  double max_error = 0;  ///< the largest of any channel of any pixel
  double off_share = 0;  ///< of pixels with a channel off by more than 1/255
};

/// Between two images of the same size, before rounding to 8 bits.
Difference difference(const Image& image, const Image& reference);

}  // namespace raytracer
