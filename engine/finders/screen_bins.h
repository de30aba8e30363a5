// Which primitives each block of pixels may show, near to far.
//
// All rays from the eye share their origin, so a 2-D structure finds what they meet: the image, cut
// into blocks. Every primitive is entered into the blocks that its footprint may touch.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/finders/binning.h"
#include "engine/math/block.h"
#include "engine/math/projection.h"
#include "engine/math/view.h"
#include "engine/memory/page_allocator.h"
#include "engine/packets/padding.h"
#include "engine/parallel/worker_pool.h"

namespace raytracer {

/// A primitive in a block.
struct ScreenEntry {
  float nearest;            ///< a lower bound of its distance from the eye
  std::uint32_t primitive;  ///< as whoever filled the bins numbers it
};

/// Those of a block, nearest first.
struct BlockEntries {
  std::span<const ScreenEntry> entries;
  /// Which of the block's subtiles each may touch: as Parts has them, row 0 on top. Vectors that
  /// begin with any of them may be read.
  const Parts* subtiles = nullptr;
};

/// Entries by block, blocks row by row from the top. What an entry may touch is kept apart, so that
/// many are looked through at once.
struct ScreenBins {
  BinGrid blocks{};
  std::vector<std::uint32_t> begins;  ///< of each block, and the end of the last
  LargeArray<ScreenEntry> entries;
  LargeArray<Parts> subtiles;  ///< as in BlockEntries

  /// Those of the block at (column, row); nothing if nothing was entered anywhere.
  BlockEntries block(int column, int row) const {
    if (entries.empty()) return {};
    const std::size_t index = blocks.index(column, row);
    const std::uint32_t begin = begins[index];
    return {std::span(entries).subspan(begin, begins[index + 1] - begin), subtiles.data() + begin};
  }
};

/// Of what finds its own parts: only the parts of each block that may show some of it.
struct ScreenMask {
  BinGrid blocks{};
  std::vector<Parts> subtiles;  ///< of each block, as in BlockEntries; empty if there is none

  Parts block(int column, int row) const {
    return subtiles.empty() ? Parts{0} : subtiles[blocks.index(column, row)];
  }
};

namespace screen_bins {

static_assert(subtiles_across == parts_across);  // so a block's subtiles are its parts

inline BinGrid blocks_of(const View& view) {
  return {static_cast<int>(blocks_along(view.width)), static_cast<int>(blocks_along(view.height)),
          2};
}

/// The subtiles of an image of so many blocks that the rectangle touches.
CellRectangle subtiles_touched(const PixelRectangle& pixels, const BinGrid& blocks);

/// The pixels of the block at (column, row).
inline PixelRectangle block_pixels(int column, int row) {
  const double x = static_cast<double>(column) * block_side;
  const double y = static_cast<double>(row) * block_side;
  return {x, y, x + block_side, y + block_side};
}

/// An entry on its way to its block.
struct BinnedEntry {
  ScreenEntry entry;
  Parts subtiles;  ///< as in BlockEntries
};

/// Nearest first. Distances are not negative: their order is that of their bits, and a radix sort
/// of those takes a fifth of the time that comparisons take in a block of hundreds.
void sort_by_distance(std::span<BinnedEntry> entries);

/// By how much distances exceed depths in each block, at least.
inline std::vector<float> distances_per_depth(const Projection& projection, const BinGrid& blocks) {
  std::vector<float> ratios(blocks.bin_count());
  for (int row = 0; row < blocks.rows; ++row)
    for (int column = 0; column < blocks.columns; ++column)
      ratios[blocks.index(column, row)] =
          static_cast<float>(projection.distance_per_depth(block_pixels(column, row)) * (1 - 1e-6));
  return ratios;
}

}  // namespace screen_bins

/// A lower bound of the depth of what the image can show of a primitive: entries are then in order
/// of that, and not of the distance from the eye.
template <typename Primitive>
concept HasScreenDepth = requires(const Projection& projection, const Primitive& p) {
  { screen_depth(projection, p) } -> std::same_as<double>;
};

/// The lines between which it is seen: of the blocks of its footprint it then touches only what
/// those leave.
template <typename Primitive>
concept HasScreenOutline = requires(const View& view, const Primitive& p) {
  screen_outline(view, p);
};

/// Bins of primitives, numbered by number(i), on the pool's threads.
template <typename Primitive, typename Number>
ScreenBins build_screen_bins(const View& view, std::span<const Primitive> primitives,
                             const Number& number, WorkerPool& pool) {
  using namespace screen_bins;
  ScreenBins bins;
  bins.blocks = blocks_of(view);
  const Projection projection(view);
  std::vector<float> per_depth;
  if constexpr (HasScreenDepth<Primitive>) per_depth = distances_per_depth(projection, bins.blocks);
  const auto place = [&](std::size_t i) -> Placed<BinnedEntry> {
    const Primitive& primitive = primitives[i];
    const CellRectangle subtiles = subtiles_touched(footprint(projection, primitive), bins.blocks);
    if (subtiles.empty()) return {};
    double nearest = 0;
    if constexpr (HasScreenDepth<Primitive>)
      nearest = screen_depth(projection, primitive);
    else
      nearest = nearest_distance(primitive);
    // Rounded down: by more than the rounding of the distance and of the cast.
    return {subtiles, {{static_cast<float>(std::max(nearest * (1 - 1e-6), 0.0)), number(i)}, 0}};
  };
  const auto entries_of = [&](const BinnedEntry& whole, const CellRectangle& subtiles) {
    const auto entry_in = [&, whole](int column, int row, Parts touched) {
      BinnedEntry binned = whole;
      if constexpr (HasScreenDepth<Primitive>)
        binned.entry.nearest *= per_depth[bins.blocks.index(column, row)];
      binned.subtiles = touched;
      return binned;
    };
    if constexpr (HasScreenOutline<Primitive>) {
      const TouchedParts touched(subtiles, [&] {
        return PartOutline(screen_outline(view, primitives[whole.entry.primitive]), block_side,
                           block_side, projection_margin_px);
      });
      return [entry_in, touched](int column, int row) {
        return entry_in(column, row,
                        touched.of_bin(column, row, column * block_side, row * block_side));
      };
    } else {
      return [entry_in, subtiles](int column, int row) {
        return entry_in(column, row, parts_in(subtiles, column, row));
      };
    }
  };
  bins.begins = sort_into_bins<BinnedEntry>(
      primitives.size(), bins.blocks, pool, place, entries_of, &sort_by_distance,
      [&](std::size_t count) {
        bins.entries.resize(count);
        bins.subtiles.resize(count + packet_padding);
      },
      [&](std::size_t first, std::span<const BinnedEntry> block) {
        for (std::size_t i = 0; i < block.size(); ++i) {
          bins.entries[first + i] = block[i].entry;
          bins.subtiles[first + i] = block[i].subtiles;
        }
      });
  return bins;
}

/// The subtiles that may show any of them.
template <typename Primitive>
ScreenMask build_screen_mask(const View& view, std::span<const Primitive> primitives) {
  using namespace screen_bins;
  ScreenMask mask;
  mask.blocks = blocks_of(view);
  if (!primitives.empty()) mask.subtiles.assign(mask.blocks.bin_count(), 0);
  const Projection projection(view);
  for (const Primitive& primitive : primitives) {
    const CellRectangle subtiles = subtiles_touched(footprint(projection, primitive), mask.blocks);
    if (subtiles.empty()) continue;
    const CellRectangle blocks = mask.blocks.bins_of(subtiles);
    for (int row = blocks.y_begin; row < blocks.y_end; ++row)
      for (int column = blocks.x_begin; column < blocks.x_end; ++column)
        mask.subtiles[mask.blocks.index(column, row)] |= parts_in(subtiles, column, row);
  }
  return mask;
}

}  // namespace raytracer
