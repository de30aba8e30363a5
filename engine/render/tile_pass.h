// What a pass over the tiles of an image takes and tells.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

#include "engine/kernel/beyond_range.h"
#include "engine/parallel/worker_pool.h"

namespace raytracer {

/// One pass over tiles: who traces them, and who hears of it, from several threads.
struct TilePass {
  WorkerPool& pool;
  std::atomic<bool>& stop;
  /// That a tile is in the picture; it may set `stop`.
  std::function<void(std::size_t, const BeyondRange&)> finished;
  /// How much of the pass is done, where tiles are not finished one after another; likewise.
  std::function<void(double)> report;
};

}  // namespace raytracer
