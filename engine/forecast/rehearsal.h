// A small part of a render, to tell what all of it will take.
//
// A model that counts what rays meet has to count as the kernels do, and is wrong as soon as they
// change. The kernels themselves are always right: this traces tiles spread evenly over the image
// with the structures of the render itself and takes their mean for that of all tiles. Structures
// are therefore built first, which for a million spheres takes about as long as to read them.
//
// Limits: times are those of threads that have a core each, whatever else the machine does now. Of
// an image of so few tiles that all are timed, each comes after one from elsewhere, and takes
// longer than in a render. A detail between the tiles is not in the error.
#pragma once

#include <cstddef>

#include "engine/forecast/swept_tiles.h"
#include "engine/parallel/worker_pool.h"
#include "engine/render/progress.h"
#include "engine/render/tracer.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// Means over the tiles that were traced.
struct Rehearsal {
  std::size_t tile_count = 0;  ///< of the image
  std::size_t timed = 0;       ///< tiles traced with one sample per pixel
  std::size_t compared = 0;    ///< of these, also with more
  double tile_ms = 0;          ///< on one thread, with one sample per pixel
  double sample_ms = 0;        ///< and for each sample beyond the first
  double error = 0;            ///< rms, of one sample per pixel
  double error_exponent = 0;   ///< the error of n samples is that of one, times n^-exponent
  /// Refined pixel by pixel, the image needs this share of the samples that it needs with as many
  /// everywhere, for the same error.
  double refined_share = 1;
  double refined_sample_ms = 0;  ///< of a tile's pixels, each one sample, where it is refined
  SweepCost sweeps{};            ///< beside all tiles'

  /// Milliseconds of one thread for all tiles with `samples` per pixel.
  double image_ms(double samples) const {
    return static_cast<double>(tile_count) * (tile_ms + (samples - 1) * sample_ms) +
           sweeps.ms(samples);
  }
  double error_of(double samples) const;
};

/// Takes some `pass_limit_ms` for each of its two passes, and at least one tile; where soft light
/// is swept, as long as three passes' sweeps. Ends soon after `progress.stop`, and then its figures
/// mean nothing.
Rehearsal rehearse(const Scene& scene, const Tracer& tracer, WorkerPool& pool,
                   const RenderProgress& progress, double pass_limit_ms);

}  // namespace raytracer
