#include "engine/accel/screen_bins.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "engine/accel/box.h"
#include "engine/accel/projection.h"
#include "engine/math/block.h"

namespace raytracer {
namespace {

/// The parts of an image of so many blocks that the rectangle touches.
CellRectangle parts_touched(const PixelRectangle& pixels, const BinGrid& blocks) {
  if (!(pixels.x_begin < pixels.x_end && pixels.y_begin < pixels.y_end)) return {};
  // A rectangle beside the image clamps to nothing.
  const auto index = [&](double pixel, int most) {
    return static_cast<int>(std::clamp(pixel / part_side, 0.0, static_cast<double>(most)));
  };
  const int columns = parts_across * blocks.columns;
  const int rows = parts_across * blocks.rows;
  return {index(pixels.x_begin, columns), index(pixels.y_begin, rows),
          index(pixels.x_end + part_side, columns), index(pixels.y_end + part_side, rows)};
}

/// The parts of the block at (column, row) that lie in `parts`, which counts parts of the image.
std::uint16_t part_mask(const CellRectangle& parts, int column, int row) {
  const int x_begin = std::max(parts.x_begin - parts_across * column, 0);
  const int x_end = std::min(parts.x_end - parts_across * column, parts_across);
  const int y_begin = std::max(parts.y_begin - parts_across * row, 0);
  const int y_end = std::min(parts.y_end - parts_across * row, parts_across);
  const unsigned in_row = ((1U << x_end) - 1U) & ~((1U << x_begin) - 1U);
  unsigned mask = 0;
  for (int y = y_begin; y < y_end; ++y) mask |= in_row << (parts_across * y);
  return static_cast<std::uint16_t>(mask);
}

/// The pixels of the block at (column, row).
PixelRectangle block_pixels(int column, int row) {
  const double x = static_cast<double>(column) * block_side;
  const double y = static_cast<double>(row) * block_side;
  return {x, y, x + block_side, y + block_side};
}

/// Those of a block's parts that the triangle reaches.
std::uint16_t parts_reached(const TriangleSides& sides, const PixelRectangle& block,
                            std::uint16_t mask) {
  if (!sides.reach(block)) return 0;
  unsigned reached = 0;
  for (int row = 0; row < parts_across; ++row) {
    for (int column = 0; column < parts_across; ++column) {
      const unsigned part = 1U << (parts_across * row + column);
      const double x = block.x_begin + part_side * column;
      const double y = block.y_begin + part_side * row;
      if ((mask & part) != 0 && sides.reach({x, y, x + part_side, y + part_side})) reached |= part;
    }
  }
  return static_cast<std::uint16_t>(reached);
}

/// The space that holds a square's spheres.
Box bound(const PackedSquare& square) {
  const double half = square.radius * static_cast<double>(square.side);
  const auto reach = [&](int axis) { return axis == square.across ? square.radius : half; };
  const Vec3 extent{reach(0), reach(1), reach(2)};
  return Box{square.center - extent, square.center + extent}.padded(0);
}

/// An entry on its way to its block.
struct BinnedEntry {
  ScreenEntry entry;
  std::uint16_t parts;  ///< as in BlockEntries
};

/// Nearest first. Distances are not negative: their order is that of their bits, and a radix sort
/// of those takes a fifth of the time that comparisons take in a block of hundreds.
void sort_by_distance(std::span<BinnedEntry> entries) {
  constexpr std::size_t few = 48;
  constexpr int digit_bits = 8;
  constexpr std::uint32_t digits = 1U << digit_bits;
  if (entries.size() <= few) {
    std::sort(entries.begin(), entries.end(), [](const BinnedEntry& a, const BinnedEntry& b) {
      return a.entry.nearest < b.entry.nearest;
    });
    return;
  }
  std::vector<BinnedEntry> other(entries.size());
  std::span<BinnedEntry> from = entries;
  std::span<BinnedEntry> to = other;
  for (int shift = 0; shift < 32; shift += digit_bits) {
    const auto digit = [shift](const BinnedEntry& binned) {
      return std::bit_cast<std::uint32_t>(binned.entry.nearest) >> shift & (digits - 1);
    };
    std::array<std::uint32_t, digits> next{};
    for (const BinnedEntry& binned : from) ++next[digit(binned)];
    if (next[digit(from[0])] == from.size()) continue;
    std::exclusive_scan(next.begin(), next.end(), next.begin(), 0U);
    for (const BinnedEntry& binned : from) to[next[digit(binned)]++] = binned;
    std::swap(from, to);
  }
  if (from.data() != entries.data()) std::copy(from.begin(), from.end(), entries.begin());
}

/// As sort_into_bins, into `lists`.
template <typename Place, typename EntryIn>
void sort_into_lists(std::size_t item_count, const BinGrid& blocks, WorkerPool& pool,
                     const Place& place, const EntryIn& entry_in, ScreenLists& lists) {
  constexpr std::size_t padding = 64;  // longer than any vector of parts
  lists.begins = sort_into_bins(
      item_count, blocks, pool, make_binning<BinnedEntry>(place, entry_in, &sort_by_distance),
      [&](std::size_t count) {
        lists.entries.resize(count);
        lists.parts.resize(count + padding);
      },
      [&](std::size_t first, std::span<const BinnedEntry> block) {
        for (std::size_t i = 0; i < block.size(); ++i) {
          lists.entries[first + i] = block[i].entry;
          lists.parts[first + i] = block[i].parts;
        }
      });
}

/// Fills in the bins' triangles.
void bin_triangles(const View& view, std::span<const PackedTriangle> triangles, WorkerPool& pool,
                   ScreenBins& bins) {
  const BinGrid& blocks = bins.blocks;
  const Projection projection(view);
  std::vector<float> distance_per_depth(blocks.bin_count());
  for (int row = 0; row < blocks.rows; ++row)
    for (int column = 0; column < blocks.columns; ++column)
      distance_per_depth[blocks.index(column, row)] =
          static_cast<float>(projection.distance_per_depth(block_pixels(column, row)) * (1 - 1e-6));

  const auto place = [&](std::size_t i) -> Placed<BinnedEntry> {
    const PackedTriangle& triangle = triangles[i];
    const CellRectangle parts = parts_touched(projection.of_triangle(triangle), blocks);
    if (parts.empty()) return {};
    const auto nearest = static_cast<float>(projection.depth(triangle) * (1 - 1e-6));
    return {parts, {{nearest, static_cast<std::uint32_t>(i)}, 0}};
  };
  const auto entry_in = [&](BinnedEntry binned, const CellRectangle& parts, int column, int row) {
    binned.entry.nearest *= distance_per_depth[blocks.index(column, row)];
    binned.parts = part_mask(parts, column, row);
    if (parts.x_end - parts.x_begin > parts_across && parts.y_end - parts.y_begin > parts_across)
      binned.parts = parts_reached(TriangleSides(view, triangles[binned.entry.primitive]),
                                   block_pixels(column, row), binned.parts);
    return binned;
  };
  sort_into_lists(triangles.size(), blocks, pool, place, entry_in, bins.triangles);
}

}  // namespace

ScreenBins build_screen_bins(const View& view, std::span<const PackedSphere> spheres,
                             const Numbering& numbers, const std::vector<PackedSquare>& squares,
                             std::span<const PackedTriangle> triangles, WorkerPool& pool) {
  ScreenBins bins;
  bins.blocks = {(view.width + block_side - 1) / block_side,
                 (view.height + block_side - 1) / block_side, 2};
  const Projection projection(view);
  const auto place = [&](std::size_t i) -> Placed<BinnedEntry> {
    const PackedSphere& s = spheres[i];
    const CellRectangle parts =
        parts_touched(projection.of_sphere(s.center, s.radius), bins.blocks);
    if (parts.empty()) return {};
    // Rounded down: by more than the rounding of the distance and of the cast.
    const double nearest = (length(s.center) - s.radius) * (1 - 1e-6);
    return {
        parts,
        {{static_cast<float>(std::max(nearest, 0.0)), static_cast<std::uint32_t>(numbers(s.id))},
         0}};
  };
  const auto entry_in = [](BinnedEntry binned, const CellRectangle& parts, int column, int row) {
    binned.parts = part_mask(parts, column, row);
    return binned;
  };
  sort_into_lists(spheres.size(), bins.blocks, pool, place, entry_in, bins.spheres);

  if (!triangles.empty()) bin_triangles(view, triangles, pool, bins);

  if (!squares.empty()) bins.squares.assign(bins.blocks.bin_count(), 0);
  for (const PackedSquare& square : squares) {
    const CellRectangle parts = parts_touched(projection.of_box(bound(square)), bins.blocks);
    if (parts.empty()) continue;
    const CellRectangle blocks = bins.blocks.bins_of(parts);
    for (int row = blocks.y_begin; row < blocks.y_end; ++row)
      for (int column = blocks.x_begin; column < blocks.x_end; ++column)
        bins.squares[bins.blocks.index(column, row)] |= part_mask(parts, column, row);
  }
  return bins;
}

}  // namespace raytracer
