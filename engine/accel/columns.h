// Entries, each a structure, written as columns, each an array: what a packet loads at once.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "engine/memory/page_allocator.h"

namespace raytracer {

/// The array that takes one member of each entry.
template <typename Entry, typename T>
struct Column {
  LargeArray<T>* values;
  T Entry::*member;
};

template <typename Entry, typename T>
class Columns {
 public:
  explicit Columns(std::vector<Column<Entry, T>> columns) : columns_(std::move(columns)) {}

  /// Makes room for `count` entries, and beyond them for a packet that begins at the last one.
  void resize(std::size_t count) const {
    constexpr std::size_t padding = 64;  // longer than any packet
    for (const Column<Entry, T>& column : columns_) column.values->resize(count + padding);
  }

  void write(std::size_t first, std::span<const Entry> entries) const {
    for (const Column<Entry, T>& column : columns_)
      for (std::size_t i = 0; i < entries.size(); ++i)
        (*column.values)[first + i] = entries[i].*column.member;
  }

 private:
  std::vector<Column<Entry, T>> columns_;
};

}  // namespace raytracer
