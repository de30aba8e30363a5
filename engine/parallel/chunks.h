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

/// Calls visit(begin, end) for ranges that together are 0 ... count, on the pool's threads if
/// there are enough items to be worth waking them.
template <typename Visit>
void for_each_range(std::size_t count, WorkerPool& pool, const Visit& visit) {
  constexpr std::size_t few = 4096;
  if (count < few)
    visit(std::size_t{0}, count);
  else
    for_each_chunk(count, pool.thread_count(), pool,
                   [&](std::size_t, std::size_t begin, std::size_t end) { visit(begin, end); });
}

}  // namespace raytracer
