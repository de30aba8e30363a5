// Tiles of a rehearsal whose soft light is swept for all of them together.
#pragma once

#include <atomic>
#include <span>
#include <vector>

#include "engine/parallel/worker_pool.h"
#include "engine/render/tracer.h"

namespace raytracer {

/// What primitives take to pass over points, however many these are.
struct SweepCost {
  double all_ms = 0;  ///< of one thread, along all directions
  int sets = 1;  ///< of directions, of which neighbouring pixels and samples use different ones
  double share_of_sets = 1;   ///< of all directions; the others are used by all
  double pixels_at_once = 1;  ///< of one sample
  double pixels = 0;          ///< of the image

  /// For the image with so many samples per pixel.
  double ms(double samples) const;
};

/// What tiles took, in milliseconds of one thread.
struct SweptTiles {
  std::vector<double> tile_ms;  ///< of each, without its sweeps
  double sweeps_ms = 0;         ///< of all together
};

bool is_swept(const Tracer& tracer);

/// Traces the tiles on the pool's threads; once `stop` is set its figures mean nothing.
SweptTiles trace_swept(const Tracer& tracer, const SamplePattern& pattern,
                       std::span<const Tile> tiles, const TileOutput& output, WorkerPool& pool,
                       const std::atomic<bool>& stop);

/// By the few points of one tile, the first of these that has any.
SweepCost measure_sweeps(const Tracer& tracer, std::span<const Tile> tiles);

}  // namespace raytracer
