// Cutting a large range of primitives with all threads.
//
// A range is worked on in chunks of a fixed size, so that the outcome does not depend on the number
// of threads.
#pragma once

#include <vector>

#include "engine/finders/tree_split.h"
#include "engine/parallel/worker_pool.h"

namespace raytracer {

/// The steps of a split, as in tree_split.h. Refers to records and pool.
class ParallelSplit {
 public:
  ParallelSplit(TreeRecord* records, WorkerPool& pool) : records_(records), pool_(pool) {}

  Part bound(const Range& range);
  Bins count(const Range& range, const BinScale& scale);
  Sides partition(const Range& range, const BinScale& scale, const Cut& cut);

 private:
  template <typename Task>
  void for_chunks(const Range& range, const Task& task);
  void exchange(const Range& range, const std::vector<Sides>& sides, std::uint32_t middle);

  TreeRecord* const records_;
  WorkerPool& pool_;
};

}  // namespace raytracer
