// A range of items cut into as many chunks as there are threads.
#pragma once

#include <atomic>
#include <cstddef>

#include "engine/parallel/worker_pool.h"

namespace raytracer {

/// Calls visit(chunk, begin, end) on the pool's threads for ranges that together are 0 ... count,
/// in order of `chunk` from 0 to `chunk_count` - 1.
template <typename Visit>
void for_each_chunk(std::size_t count, std::size_t chunk_count, WorkerPool& pool,
                    const Visit& visit) {
  const std::atomic<bool> never{false};
  pool.run(
      chunk_count,
      [&](std::size_t chunk) {
        visit(chunk, count * chunk / chunk_count, count * (chunk + 1) / chunk_count);
      },
      never);
}

}  // namespace raytracer
