// Building a tree of boxes by the surface area heuristic, on all threads.
//
// A node takes eight children by splitting the largest again (Wald, Benthin, Boulos: "Getting Rid
// of Packets", 2008). Large ranges are split by all threads together, the rest is one task for
// each subtree. The tree does not depend on the number of threads.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/finders/tree.h"
#include "engine/finders/tree_split.h"
#include "engine/math/box.h"
#include "engine/memory/page_allocator.h"
#include "engine/parallel/chunks.h"
#include "engine/parallel/worker_pool.h"

namespace raytracer {

/// The records are reordered. There are less than 2^29.
Tree build_tree(TreeRecord* records, std::uint32_t count, WorkerPool& pool);

/// A tree over primitives 0 to count - 1. `bound_of(i)` gives the box of one, and is called from
/// several threads.
template <typename BoundOf>
Tree build_tree(std::size_t count, const BoundOf& bound_of, WorkerPool& pool) {
  LargeArray<TreeRecord> records(count);
  for_each_chunk(count, pool.thread_count(), pool,
                 [&](std::size_t, std::size_t begin, std::size_t end) {
                   for (std::size_t i = begin; i < end; ++i)
                     records[i] = TreeRecord::of(bound_of(i), static_cast<std::uint32_t>(i));
                 });
  return build_tree(records.data(), static_cast<std::uint32_t>(count), pool);
}

}  // namespace raytracer
