// Which primitives the cells of a light's grid name, those that reach nearest to the light first.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/finders/binning.h"
#include "engine/memory/page_allocator.h"

namespace raytracer {

/// A primitive that a cell names.
template <typename T>
struct ListedCaster {
  T top;  ///< how far it reaches towards the light
  std::uint32_t primitive;

  /// Where it turns out not to touch the cell: behind all others, where none looks for it.
  static constexpr T nowhere = std::numeric_limits<T>::lowest();
};

/// The names of all cells.
template <typename T>
struct CellLists {
  std::vector<std::uint32_t> begins;  ///< of each cell, row by row, and the end of the last
  LargeArray<ListedCaster<T>> entries;
};

/// As sort_into_bins().
template <typename T, typename Place, typename EntriesOf>
CellLists<T> list_in_cells(std::size_t item_count, const BinGrid& cells, WorkerPool& pool,
                           const Place& place, const EntriesOf& entries_of) {
  using Entry = ListedCaster<T>;
  CellLists<T> lists;
  const auto arrange = [](std::span<Entry> cell) {
    std::sort(cell.begin(), cell.end(),
              [](const Entry& a, const Entry& b) { return a.top > b.top; });
  };
  lists.begins = sort_into_bins<Entry>(
      item_count, cells, pool, place, entries_of, arrange,
      [&](std::size_t count) { lists.entries.resize(count); },
      [&](std::size_t first, std::span<const Entry> cell) {
        std::copy(cell.begin(), cell.end(),
                  lists.entries.begin() + static_cast<std::ptrdiff_t>(first));
      });
  return lists;
}

}  // namespace raytracer
