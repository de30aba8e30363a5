// What threads do of a pass that refines an image.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/sample/pixel_errors.h"
#include "engine/sample/refinement.h"

namespace raytracer {

/// A block, or some pixels of blocks.
struct RefinementTask {
  double samples = 0;     ///< in all
  double error2 = 0;      ///< of its pixels, as expected
  std::size_t begin = 0;  ///< of its pixels among those of the pass ...
  std::size_t end = 0;    ///< ... up to here
  int samples_per_pixel = 0;
};

/// One for each block of the image in turn, with as many samples in all pixels.
std::vector<RefinementTask> block_tasks(const PixelErrors& errors, int samples);

/// For pixels that are block by block. They are sorted, and stay block by block among those that
/// get as many samples: each task's are side by side.
std::vector<RefinementTask> pixel_tasks(std::vector<PixelSamples>& pixels,
                                        const PixelErrors& errors);

/// The order in which tasks help most in the time that they take.
std::vector<std::size_t> most_useful_first(const std::vector<RefinementTask>& tasks);

}  // namespace raytracer
