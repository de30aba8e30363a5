// A range of items cut into chunks.
#pragma once

#include <cstddef>

#include "engine/parallel/worker_pool.h"

namespace raytracer {

/// So few items are dealt with before another thread has woken up.
inline constexpr std::size_t few_items = 4096;

/// Calls visit(chunk, begin, end) for ranges that together are 0 ... count, in order of `chunk`
/// from 0 to `chunk_count` - 1: on the pool's threads, or here if there is only one.
template <typename Visit>
void for_each_chunk(std::size_t count, std::size_t chunk_count, WorkerPool& pool,
                    const Visit& visit) {
  if (chunk_count == 1) return visit(std::size_t{0}, std::size_t{0}, count);
  pool.run(chunk_count, [&](std::size_t chunk) {
    visit(chunk, count * chunk / chunk_count, count * (chunk + 1) / chunk_count);
  });
}

/// The same with a pool or, all here and in the order of the chunks, without.
template <typename Visit>
void for_each_chunk(std::size_t count, std::size_t chunk_count, WorkerPool* pool,
                    const Visit& visit) {
  if (pool != nullptr) return for_each_chunk(count, chunk_count, *pool, visit);
  for (std::size_t chunk = 0; chunk < chunk_count; ++chunk)
    visit(chunk, count * chunk / chunk_count, count * (chunk + 1) / chunk_count);
}

/// Calls visit(begin, end) for ranges that together are 0 ... count, on the pool's threads unless
/// there are few items.
template <typename Visit>
void for_each_range(std::size_t count, WorkerPool& pool, const Visit& visit) {
  for_each_chunk(count, count < few_items ? 1 : pool.thread_count(), pool,
                 [&](std::size_t, std::size_t begin, std::size_t end) { visit(begin, end); });
}

/// The same with a pool, or without.
template <typename Visit>
void for_each_range(std::size_t count, WorkerPool* pool, const Visit& visit) {
  if (pool != nullptr) return for_each_range(count, *pool, visit);
  visit(std::size_t{0}, count);
}

}  // namespace raytracer
