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

namespace raytracer {
namespace {

/// The squares of `side` pixels, `columns` x `rows` in all, that the rectangle touches.
CellRectangle squares_touched(const PixelRectangle& pixels, int side, int columns, int rows) {
  if (!(pixels.x_begin < pixels.x_end && pixels.y_begin < pixels.y_end)) return {};
  // A rectangle beside the image clamps to nothing.
  const auto index = [&](double pixel, int most) {
    return static_cast<int>(std::clamp(pixel / side, 0.0, static_cast<double>(most)));
  };
  return {index(pixels.x_begin, columns), index(pixels.y_begin, rows),
          index(pixels.x_end + side, columns), index(pixels.y_end + side, rows)};
}

/// The parts of the block at (column, row) that lie in `parts`, which counts parts of the image.
std::uint16_t part_mask(const CellRectangle& parts, int column, int row) {
  const int x_begin = std::max(parts.x_begin - 4 * column, 0);
  const int x_end = std::min(parts.x_end - 4 * column, 4);
  const int y_begin = std::max(parts.y_begin - 4 * row, 0);
  const int y_end = std::min(parts.y_end - 4 * row, 4);
  const unsigned in_row = ((1U << x_end) - 1U) & ~((1U << x_begin) - 1U);
  unsigned mask = 0;
  for (int y = y_begin; y < y_end; ++y) mask |= in_row << (4 * y);
  return static_cast<std::uint16_t>(mask);
}

/// The square of `side` pixels at (column, row).
PixelRectangle square_pixels(int column, int row, int side) {
  const double x = static_cast<double>(column) * side;
  const double y = static_cast<double>(row) * side;
  return {x, y, x + side, y + side};
}

/// Those of a block's parts that the triangle reaches.
std::uint16_t parts_reached(const TriangleSides& sides, const PixelRectangle& block,
                            std::uint16_t mask) {
  if (!sides.reach(block)) return 0;
  const double side = (block.x_end - block.x_begin) / 4;
  unsigned reached = 0;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      const unsigned part = 1U << (4 * row + column);
      const double x = block.x_begin + side * column;
      const double y = block.y_begin + side * row;
      if ((mask & part) != 0 && sides.reach({x, y, x + side, y + side})) reached |= part;
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

/// Nearest first. Distances are not negative: their order is that of their bits, and a radix sort
/// of those takes a fifth of the time that comparisons take in a block of hundreds.
void sort_by_distance(std::span<ScreenEntry> entries) {
  constexpr std::size_t few = 48;
  constexpr int digit_bits = 8;
  constexpr std::uint32_t digits = 1U << digit_bits;
  if (entries.size() <= few) {
    std::sort(entries.begin(), entries.end(),
              [](const ScreenEntry& a, const ScreenEntry& b) { return a.nearest < b.nearest; });
    return;
  }
  std::vector<ScreenEntry> other(entries.size());
  std::span<ScreenEntry> from = entries;
  std::span<ScreenEntry> to = other;
  for (int shift = 0; shift < 32; shift += digit_bits) {
    const auto digit = [shift](const ScreenEntry& entry) {
      return std::bit_cast<std::uint32_t>(entry.nearest) >> shift & (digits - 1);
    };
    std::array<std::uint32_t, digits> next{};
    for (const ScreenEntry& entry : from) ++next[digit(entry)];
    if (next[digit(from[0])] == from.size()) continue;
    std::exclusive_scan(next.begin(), next.end(), next.begin(), 0U);
    for (const ScreenEntry& entry : from) to[next[digit(entry)]++] = entry;
    std::swap(from, to);
  }
  if (from.data() != entries.data()) std::copy(from.begin(), from.end(), entries.begin());
}

/// Fills in the bins' triangles.
void bin_triangles(const View& view, std::span<const PackedTriangle> triangles, int block_side,
                   WorkerPool& pool, ScreenBins& bins) {
  const BinGrid& blocks = bins.blocks;
  const Projection projection(view);
  std::vector<float> distance_per_depth(blocks.bin_count());
  for (int row = 0; row < blocks.rows; ++row)
    for (int column = 0; column < blocks.columns; ++column)
      distance_per_depth[blocks.index(column, row)] = static_cast<float>(
          projection.distance_per_depth(square_pixels(column, row, block_side)) * (1 - 1e-6));

  const auto cells_of = [&](std::size_t i) {
    return squares_touched(projection.of_triangle(triangles[i]), block_side / 4, 4 * blocks.columns,
                           4 * blocks.rows);
  };
  const auto entry_of = [&](std::size_t i) {
    return ScreenEntry{static_cast<float>(projection.depth(triangles[i]) * (1 - 1e-6)),
                       static_cast<std::uint32_t>(i), 0};
  };
  const auto entry_in = [&](ScreenEntry entry, const CellRectangle& parts, int column, int row) {
    entry.nearest *= distance_per_depth[blocks.index(column, row)];
    entry.parts = part_mask(parts, column, row);
    if (parts.x_end - parts.x_begin > 4 && parts.y_end - parts.y_begin > 4)
      entry.parts = parts_reached(TriangleSides(view, triangles[entry.primitive]),
                                  square_pixels(column, row, block_side), entry.parts);
    return entry;
  };
  bins.triangle_begins = sort_into_bins(
      triangles.size(), blocks, pool,
      make_binning<ScreenEntry>(cells_of, entry_of, entry_in, &sort_by_distance),
      [&](std::size_t count) { bins.triangles.resize(count); },
      [&](std::size_t first, std::span<const ScreenEntry> entries) {
        std::copy(entries.begin(), entries.end(),
                  bins.triangles.begin() + static_cast<std::ptrdiff_t>(first));
      });
}

}  // namespace

ScreenBins build_screen_bins(const View& view, std::span<const PackedSphere> spheres,
                             const std::vector<PackedSquare>& squares,
                             std::span<const PackedTriangle> triangles, int block_side,
                             WorkerPool& pool) {
  ScreenBins bins;
  bins.blocks = {(view.width + block_side - 1) / block_side,
                 (view.height + block_side - 1) / block_side, 2};
  const Projection projection(view);
  const auto parts_touched = [&](const PixelRectangle& pixels) {
    return squares_touched(pixels, block_side / 4, 4 * bins.blocks.columns, 4 * bins.blocks.rows);
  };

  const auto cells_of = [&](std::size_t i) {
    return parts_touched(projection.of_sphere(spheres[i].center, spheres[i].radius));
  };
  const auto entry_of = [&](std::size_t i) {
    // Rounded down: by more than the rounding of the distance and of the cast.
    const double nearest = (length(spheres[i].center) - spheres[i].radius) * (1 - 1e-6);
    return ScreenEntry{static_cast<float>(std::max(nearest, 0.0)), static_cast<std::uint32_t>(i),
                       0};
  };
  const auto entry_in = [](ScreenEntry entry, const CellRectangle& parts, int column, int row) {
    entry.parts = part_mask(parts, column, row);
    return entry;
  };
  bins.begins = sort_into_bins(
      spheres.size(), bins.blocks, pool,
      make_binning<ScreenEntry>(cells_of, entry_of, entry_in, &sort_by_distance),
      [&](std::size_t count) { bins.spheres.resize(count); },
      [&](std::size_t first, std::span<const ScreenEntry> entries) {
        std::copy(entries.begin(), entries.end(),
                  bins.spheres.begin() + static_cast<std::ptrdiff_t>(first));
      });

  if (!triangles.empty()) bin_triangles(view, triangles, block_side, pool, bins);

  if (!squares.empty()) bins.squares.assign(bins.blocks.bin_count(), 0);
  for (const PackedSquare& square : squares) {
    const CellRectangle parts = parts_touched(projection.of_box(bound(square)));
    if (parts.empty()) continue;
    const CellRectangle blocks = bins.blocks.bins_of(parts);
    for (int row = blocks.y_begin; row < blocks.y_end; ++row)
      for (int column = blocks.x_begin; column < blocks.x_end; ++column)
        bins.squares[bins.blocks.index(column, row)] |= part_mask(parts, column, row);
  }
  return bins;
}

}  // namespace raytracer
