// Cutting a range of primitives in two where it costs rays least.
//
// Centres are counted into bins on each axis; of the cuts between bins the one is taken for which
// the halves' areas times their numbers of leaves are least in sum (Wald: "On fast Construction of
// SAH-based Bounding Volume Hierarchies", 2007).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "engine/math/box.h"

namespace raytracer {

/// Four numbers that are computed with together.
using Float4 [[gnu::vector_size(16)]] = float;
using Int4 [[gnu::vector_size(16)]] = std::int32_t;

/// A primitive while the tree is built: its box, and its index in the bits of low[3].
struct TreeRecord {
  Float4 low;
  Float4 high;

  /// Of a box that is rounded outward; `index` is below 2^29.
  static TreeRecord of(const Box& box, std::uint32_t index);

  std::uint32_t index() const;
  /// Twice the box's.
  Float4 center() const { return low + high; }
};

struct Bounds {
  Float4 low = Float4{} + std::numeric_limits<float>::infinity();
  Float4 high = Float4{} - std::numeric_limits<float>::infinity();

  // Written so that compilers see the one instruction that does it.
  void include(Float4 other_low, Float4 other_high) {
    low = other_low < low ? other_low : low;
    high = other_high > high ? other_high : high;
  }
  void include(const Bounds& other) { include(other.low, other.high); }

  float half_area() const {
    const Float4 e = high - low;
    return e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
  }
};

struct Range {
  std::uint32_t begin;
  std::uint32_t end;
  std::uint32_t size() const { return end - begin; }
};

/// A range of records with what they and their (doubled) centres extend over.
struct Part {
  Range range{};
  Bounds box{};
  Bounds centers{};
};

Part bound(const TreeRecord* records, const Range& range);

/// Which bin a centre belongs to, on each axis.
struct BinScale {
  static constexpr std::uint32_t most_bins = 16;

  Float4 low;
  Float4 bins_per_unit;  ///< 0 on an axis that cannot be cut
  std::uint32_t count;

  explicit BinScale(const Part& part);

  Int4 bins(const TreeRecord& record) const {
    return __builtin_convertvector((record.center() - low) * bins_per_unit, Int4);
  }
  std::int32_t bin(const TreeRecord& record, int axis) const {
    return static_cast<std::int32_t>((record.low[axis] + record.high[axis] - low[axis]) *
                                     bins_per_unit[axis]);
  }
};

/// What the bins hold, on each axis.
struct Bins {
  std::array<std::array<Bounds, BinScale::most_bins>, 3> boxes;
  std::array<std::array<std::uint32_t, BinScale::most_bins>, 3> sizes{};

  void count(const BinScale& scale, const TreeRecord* records, const Range& range);
  void add(const Bins& other);
};

/// A cut before a bin on an axis, and what is on its sides.
struct Cut {
  int axis;
  std::int32_t bin;
  Bounds below;
  Bounds above;
};

/// Nothing if all centres are in one place.
std::optional<Cut> best_cut(const Bins& bins, const BinScale& scale);

/// Where the records above a cut begin, and the centres on either side of it.
struct Sides {
  std::uint32_t middle;
  Bounds below;
  Bounds above;
};

/// Brings the records below the cut before those above it.
Sides partition(TreeRecord* records, const Range& range, const BinScale& scale, const Cut& cut);

}  // namespace raytracer
