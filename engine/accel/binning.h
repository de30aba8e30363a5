// Sorting items into bins in parallel, an item into as many bins as it touches.
//
// Counted first, then written: each bin's entries lie side by side in one array without gaps, in
// the items' order, whatever the number of threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/parallel/worker_pool.h"

namespace raytracer {

/// Entries by bin.
template <typename Entry>
struct Binned {
  std::vector<std::uint32_t> begins;  ///< of each bin in `entries`, and the end of the last
  std::vector<Entry> entries;
};

/// Calls emit_entries(item, emit) for each item, twice, from several threads; it must call
/// emit(bin, entry) for each bin that the item touches, the same both times.
template <typename Entry, typename EmitEntries>
Binned<Entry> sort_into_bins(std::size_t item_count, std::size_t bin_count, WorkerPool& pool,
                             const EmitEntries& emit_entries) {
  const std::size_t chunk_count = pool.thread_count();
  const auto chunk_begin = [&](std::size_t chunk) { return item_count * chunk / chunk_count; };
  const std::atomic<bool> never{false};
  // A chunk's number of entries in each bin, then where its next one goes.
  std::vector<std::vector<std::uint32_t>> places(chunk_count);
  pool.run(
      chunk_count,
      [&](std::size_t chunk) {
        places[chunk].assign(bin_count, 0);
        std::uint32_t* const counts = places[chunk].data();
        for (std::size_t item = chunk_begin(chunk); item < chunk_begin(chunk + 1); ++item)
          emit_entries(item, [&](std::size_t bin, const Entry&) { ++counts[bin]; });
      },
      never);

  Binned<Entry> binned;
  binned.begins.resize(bin_count + 1);
  std::uint32_t total = 0;
  for (std::size_t bin = 0; bin < bin_count; ++bin) {
    binned.begins[bin] = total;
    for (std::vector<std::uint32_t>& chunk_places : places) {
      const std::uint32_t count = chunk_places[bin];
      chunk_places[bin] = total;
      total += count;
    }
  }
  binned.begins[bin_count] = total;

  binned.entries.resize(total);
  pool.run(
      chunk_count,
      [&](std::size_t chunk) {
        std::uint32_t* const next = places[chunk].data();
        for (std::size_t item = chunk_begin(chunk); item < chunk_begin(chunk + 1); ++item)
          emit_entries(item, [&](std::size_t bin, const Entry& entry) {
            binned.entries[next[bin]++] = entry;
          });
      },
      never);
  return binned;
}

/// Sorts each bin's entries by `less`, and calls visit(begin, end) for each range of bins that one
/// thread has sorted.
template <typename Entry, typename Less, typename Visit>
void sort_bins(Binned<Entry>& binned, WorkerPool& pool, Less less, Visit visit) {
  const std::size_t bin_count = binned.begins.size() - 1;
  const std::size_t chunk_count = std::min<std::size_t>(bin_count, 8 * pool.thread_count());
  const std::atomic<bool> never{false};
  pool.run(
      chunk_count,
      [&](std::size_t chunk) {
        const std::size_t begin = bin_count * chunk / chunk_count;
        const std::size_t end = bin_count * (chunk + 1) / chunk_count;
        for (std::size_t bin = begin; bin < end; ++bin)
          std::sort(binned.entries.begin() + binned.begins[bin],
                    binned.entries.begin() + binned.begins[bin + 1], less);
        visit(begin, end);
      },
      never);
}

}  // namespace raytracer
