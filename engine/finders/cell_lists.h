// Which primitives the cells of a light's grid name, those that reach nearest to the light first.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/finders/binning.h"
#include "engine/finders/wide_primitives.h"
#include "engine/memory/page_allocator.h"
#include "engine/packets/padding.h"

namespace raytracer {

/// A primitive that a cell names.
template <typename T>
struct ListedCaster {
  T top;  ///< how far it reaches towards the light
  std::uint32_t primitive;
};

/// The names of all cells. Which parts of its cell a primitive may cover is kept apart, so that
/// many are looked through at once.
template <typename T>
struct CellLists {
  std::vector<std::uint32_t> begins;  ///< of each bin, row by row, and the end of the last
  LargeArray<ListedCaster<T>> entries;
  LargeArray<Parts> parts;  ///< of each entry; vectors that begin with any of them may be read
  WideEntries wide;         ///< behind those of the cells
};

namespace cell_lists {

/// An entry on its way to its cell.
template <typename T>
struct Entry {
  ListedCaster<T> caster;
  Parts parts;
};

}  // namespace cell_lists

/// As sort_into_bins(), into cells of 4 x 4 parts; entries are cell_lists::Entry.
template <typename T, typename Place, typename EntriesOf>
CellLists<T> list_in_cells(std::size_t item_count, const BinGrid& bins, WorkerPool& pool,
                           const Place& place, const EntriesOf& entries_of) {
  using Entry = cell_lists::Entry<T>;
  CellLists<T> lists;
  const auto arrange = [](std::span<Entry> cell) {
    std::sort(cell.begin(), cell.end(),
              [](const Entry& a, const Entry& b) { return a.caster.top > b.caster.top; });
  };
  lists.begins = sort_into_bins<Entry>(
      item_count, BinGrid{bins.columns, bins.rows, 2}, pool, place, entries_of, arrange,
      [&](std::size_t count) {
        lists.entries.resize(count);
        lists.parts.resize(count + packet_padding);
      },
      [&](std::size_t first, std::span<const Entry> cell) {
        for (std::size_t i = 0; i < cell.size(); ++i) {
          lists.entries[first + i] = cell[i].caster;
          lists.parts[first + i] = cell[i].parts;
        }
      });
  return lists;
}

}  // namespace raytracer
