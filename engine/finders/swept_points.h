// The points that all look along one direction, in the cells of a plane across it: primitives pass
// over them, and none is kept.
//
// Points, which have no extent, are sorted faster than primitives, which would be in several cells
// each, and primitives come in any order (G. Johnson et al., The irregular z-buffer, 2005; T. Aila,
// S. Laine, Alias-free shadow maps, 2004). Points crowd: a cell that has many is cut into finer
// ones.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/math/triple.h"
#include "engine/memory/page_allocator.h"

namespace raytracer {

/// Memory that one sweep leaves to the next.
template <typename T>
struct SweptPoints {
  /// `side` says which end of the axis a point looks to: 1 where it points, -1 opposite; 0 once it
  /// is known to lie in the dark.
  enum Column : std::size_t { column_u, column_v, column_w, column_side, column_id, column_count };
  /// Of the plane's, first those in rows, then those that crowded ones are cut into.
  struct Cell {
    T above;  ///< what is not beyond this, towards the light, hides none of its points or parts'
    T below;  ///< opposite, likewise
    std::uint32_t begin;
    std::uint32_t end;
  };
  /// The least and the most of all cells in a block, 2^block_log2 either way.
  struct Bounds {
    T above;
    T below;
  };
  static constexpr int block_log2 = 3;
  /// Of a crowded cell those that it is cut into, `across` either way; of others 0.
  struct Parts {
    std::uint32_t first;
    std::uint32_t across;
  };
  /// Points as they come, packet by packet.
  struct Found {
    LargeArray<T> values[column_count];
    LargeArray<std::uint32_t> packets;  ///< their numbers
    LargeArray<std::uint32_t> cells;    ///< of each point
    std::size_t count = 0;
  };

  Triple<T> axes[3];  ///< across the direction, and it
  T u_low{};
  T v_low{};
  T cells_per_unit{};
  T noise{};  ///< by which places may be off
  int columns = 0;
  int rows = 0;
  bool has_parts = false;

  /// What a cell in the rows is cut into.
  std::span<const Cell> parts_of(std::size_t cell) const {
    return {cells.data() + parts[cell].first, std::size_t{parts[cell].across} * parts[cell].across};
  }
  int blocks_across() const { return ((columns - 1) >> block_log2) + 1; }
  int blocks_down() const { return ((rows - 1) >> block_log2) + 1; }

  Found found;
  std::vector<Cell> cells;
  std::vector<Parts> parts;    ///< of each cell in the rows, if there are any
  std::vector<Bounds> blocks;  ///< of cells in the rows, and what they are cut into
  LargeArray<T> values;        ///< cell by cell, its columns
  /// Cell by cell: the packet's number times most_lanes, and the lane.
  LargeArray<std::uint32_t> lanes;
  std::size_t visits = 0;  ///< of cells and parts, since their bounds were renewed
};

/// In which order blocks of primitives pass over points: all of a kind's.
struct BlockOrder {
  std::vector<std::uint32_t> blocks;
  std::size_t near_count = 0;  ///< the first of them have primitives on which points lie
};

/// A box around what passes over points.
template <typename T>
struct SweptBox {
  Triple<T> low;
  Triple<T> high;
};

/// How far it reaches along an axis.
template <typename T>
struct SweptRange {
  T low;
  T high;

  SweptRange(const SweptBox<T>& box, const Triple<T>& axis) : low(0), high(0) {
    include(axis.x, box.low.x, box.high.x);
    include(axis.y, box.low.y, box.high.y);
    include(axis.z, box.low.z, box.high.z);
    const T rounding = 16 * std::numeric_limits<T>::epsilon() * size_;
    low -= rounding;
    high += rounding;
  }

 private:
  void include(T slope, T from, T to) {
    low += slope * (slope > 0 ? from : to);
    high += slope * (slope > 0 ? to : from);
    size_ += std::abs(slope) * std::max(std::abs(from), std::abs(to));
  }

  T size_ = 0;
};

}  // namespace raytracer
