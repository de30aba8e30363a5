#include "engine/accel/screen_bins.h"

#include <algorithm>
#include <cmath>

#include "engine/accel/box.h"
#include "engine/accel/projection.h"

namespace raytracer {
namespace {

/// Whole blocks or parts of blocks: begin <= index < end.
struct IndexRectangle {
  int x_begin;
  int y_begin;
  int x_end;
  int y_end;

  bool empty() const { return x_begin >= x_end || y_begin >= y_end; }
};

/// The squares of `side` pixels, `columns` x `rows` in all, that the rectangle touches.
IndexRectangle squares_touched(const PixelRectangle& pixels, int side, int columns, int rows) {
  const auto index = [&](double pixel, int most) {
    return static_cast<int>(std::clamp(std::floor(pixel / side), -1.0, static_cast<double>(most)));
  };
  if (!(pixels.x_begin < pixels.x_end && pixels.y_begin < pixels.y_end)) return {0, 0, 0, 0};
  return {std::max(index(pixels.x_begin, columns), 0), std::max(index(pixels.y_begin, rows), 0),
          std::min(index(pixels.x_end, columns) + 1, columns),
          std::min(index(pixels.y_end, rows) + 1, rows)};
}

/// The parts of the block at (column, row) that lie in `parts`, which counts parts of the image.
std::uint16_t part_mask(const IndexRectangle& parts, int column, int row) {
  const int x_begin = std::max(parts.x_begin - 4 * column, 0);
  const int x_end = std::min(parts.x_end - 4 * column, 4);
  const int y_begin = std::max(parts.y_begin - 4 * row, 0);
  const int y_end = std::min(parts.y_end - 4 * row, 4);
  if (x_begin >= x_end) return 0;
  const unsigned in_row = ((1U << x_end) - 1U) & ~((1U << x_begin) - 1U);
  unsigned mask = 0;
  for (int y = y_begin; y < y_end; ++y) mask |= in_row << (4 * y);
  return static_cast<std::uint16_t>(mask);
}

/// The space that holds a square's spheres.
Box bound(const PackedSquare& square) {
  const double half = square.radius * static_cast<double>(square.side);
  const auto reach = [&](int axis) { return axis == square.across ? square.radius : half; };
  const Vec3 extent{reach(0), reach(1), reach(2)};
  return Box{square.center - extent, square.center + extent}.padded(0);
}

}  // namespace

ScreenBins build_screen_bins(const View& view, const std::vector<PackedSphere>& spheres,
                             const std::vector<PackedSquare>& squares, int block_side,
                             WorkerPool& pool) {
  ScreenBins bins;
  bins.block_columns = (view.width + block_side - 1) / block_side;
  const int block_rows = (view.height + block_side - 1) / block_side;
  const auto block_count =
      static_cast<std::size_t>(bins.block_columns) * static_cast<std::size_t>(block_rows);
  const auto parts_touched = [&](const PixelRectangle& pixels) {
    return squares_touched(pixels, block_side / 4, 4 * bins.block_columns, 4 * block_rows);
  };
  const Projection projection(view);

  bins.spheres =
      sort_into_bins<ScreenEntry>(spheres.size(), block_count, pool, [&](std::size_t i, auto emit) {
        const PackedSphere& sphere = spheres[i];
        const IndexRectangle parts =
            parts_touched(projection.of_sphere(sphere.center, sphere.radius));
        if (parts.empty()) return;
        // Rounded down: by more than the rounding of the distance and of the cast.
        const auto nearest =
            static_cast<float>((length(sphere.center) - sphere.radius) * (1 - 1e-6));
        for (int row = parts.y_begin / 4; row <= (parts.y_end - 1) / 4; ++row)
          for (int column = parts.x_begin / 4; column <= (parts.x_end - 1) / 4; ++column)
            emit(bins.index(column, row), ScreenEntry{nearest, static_cast<std::uint32_t>(i),
                                                      part_mask(parts, column, row)});
      });
  sort_bins(
      bins.spheres, pool,
      [](const ScreenEntry& a, const ScreenEntry& b) { return a.nearest < b.nearest; },
      [](std::size_t, std::size_t) {});

  if (!squares.empty()) bins.squares.assign(block_count, 0);
  for (const PackedSquare& square : squares) {
    const IndexRectangle parts = parts_touched(projection.of_box(bound(square)));
    if (parts.empty()) continue;
    for (int row = parts.y_begin / 4; row <= (parts.y_end - 1) / 4; ++row)
      for (int column = parts.x_begin / 4; column <= (parts.x_end - 1) / 4; ++column)
        bins.squares[bins.index(column, row)] |= part_mask(parts, column, row);
  }
  return bins;
}

}  // namespace raytracer
