// The project's pictures as the published trade takes them: any setting, and one that is exact
// enough to tell the others' errors.
#pragma once

#include "engine/engine.h"

namespace raytracer::published {

/// With these settings in place of the scene's own.
Rendering render_with(const Scene& scene, const Overrides& overrides, WorkerPool& pool);

/// See engine/tradeoff/reference.h.
struct ExactPicture {
  Image image;
  int samples = 0;             ///< per pixel, in double precision
  double estimated_error = 0;  ///< rms; some three times the true one
};

ExactPicture render_exactly(const Scene& scene, int samples, WorkerPool& pool);

}  // namespace raytracer::published
