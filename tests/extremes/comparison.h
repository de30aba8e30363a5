// An image against the exact picture: how many pixels are wrong, and by how much an edge has moved.
#pragma once

#include <vector>

#include "engine/engine.h"
#include "tests/extremes/oracle.h"

namespace raytracer::extremes {

/// A colour for each pixel, row by row, row 0 on top.
using ExactImage = std::vector<Vec3>;

ExactImage exact_image(const Scene& scene, WorkerPool& pool);

struct Comparison {
  int off = 0;      ///< pixels with a channel off by more than a level of 255
  int at_edge = 0;  ///< not among them: right for an image point within 1e-6 pixel
  int nans = 0;
  /// The least distance in pixels, from 1e-6 on in steps of 2, at which the exact picture has the
  /// colour of the pixel that is farthest off in this sense; infinite beyond 8. Of the first pixels
  /// only where many are off.
  double displacement_px = 0;
  double levels = 0;  ///< the largest difference of the other pixels
};

/// `exact` is the scene's.
Comparison compare(const Image& image, const ExactImage& exact, const Scene& scene);

}  // namespace raytracer::extremes
