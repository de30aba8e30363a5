// Entries, each a structure, written as columns, each an array: what a packet loads at once.
//
// The columns of one cell after another: what a test needs of a cell lies in a few lines next to
// each other, and all cells in one array of few pages.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "engine/memory/page_allocator.h"
#include "engine/packets/padding.h"

namespace raytracer {

/// Of a structure's members, all of type T, in the columns' order.
template <typename Entry, typename T, std::size_t column_count>
using Members = std::array<T Entry::*, column_count>;

/// Cell by cell, `column_count` columns of as many values as the cell has entries.
template <typename T, std::size_t column_count>
struct CellColumns {
  LargeArray<T> values;

  /// Makes room for `entry_count` entries in all, and beyond them for a packet that begins at the
  /// last one.
  void resize(std::size_t entry_count) {
    values.resize(column_count * entry_count + packet_padding);
  }

  /// All entries of one cell, of which `first` are in the cells before it.
  template <typename Entry>
  void write(std::size_t first, std::span<const Entry> cell,
             const Members<Entry, T, column_count>& members) {
    T* to = values.data() + column_count * first;
    for (const auto member : members)
      for (const Entry& entry : cell) *to++ = entry.*member;
  }

  /// The columns of the cell whose entries begin with `first`.
  const T* cell(std::size_t first) const { return values.data() + column_count * first; }
};

}  // namespace raytracer
