#include "engine/accel/screen_bins.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytracer {
namespace {

struct Slopes {
  double low;
  double high;
};

/// The range of x / z over a circle around (x, z) in the plane, seen from the origin; all slopes
/// where the circle is not wholly in front of it.
Slopes slopes_of_circle(double x, double z, double r) {
  constexpr double all = std::numeric_limits<double>::infinity();
  if (z <= r) return {-all, all};
  const double root = r * std::sqrt(std::max(x * x + z * z - r * r, 0.0));
  const double denominator = (z - r) * (z + r);
  return {(x * z - root) / denominator, (x * z + root) / denominator};
}

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

}  // namespace

PixelRectangle project_sphere(const View& view, const Vec3& center, double radius) {
  // The view's vectors carry the field of view: a point's slopes in units of half the image.
  const double forward_scale = length(view.forward);
  const double right_scale = length(view.right);
  const double up_scale = length(view.up);
  const double z = dot(center, view.forward) / forward_scale;
  const double x = dot(center, view.right) / right_scale;
  const double y = dot(center, view.up) / up_scale;
  if (z < -radius) return {0, 0, 0, 0};
  const Slopes horizontal = slopes_of_circle(x, z, radius);
  const Slopes vertical = slopes_of_circle(y, z, radius);
  constexpr double generosity_px = 0.01;
  const auto column = [&](double slope) {
    return (slope * forward_scale / right_scale + 1) * 0.5 * view.width;
  };
  const auto row = [&](double slope) {
    return (1 - slope * forward_scale / up_scale) * 0.5 * view.height;
  };
  return {column(horizontal.low) - generosity_px, row(vertical.high) - generosity_px,
          column(horizontal.high) + generosity_px, row(vertical.low) + generosity_px};
}

ScreenBins build_screen_bins(const View& view, const std::vector<PackedSphere>& spheres,
                             int block_side, WorkerPool& pool) {
  ScreenBins bins;
  bins.block_columns = (view.width + block_side - 1) / block_side;
  const int block_rows = (view.height + block_side - 1) / block_side;
  const auto block_count =
      static_cast<std::size_t>(bins.block_columns) * static_cast<std::size_t>(block_rows);
  const int part_side = block_side / 4;

  bins.spheres =
      sort_into_bins<ScreenEntry>(spheres.size(), block_count, pool, [&](std::size_t i, auto emit) {
        const PackedSphere& sphere = spheres[i];
        const IndexRectangle parts =
            squares_touched(project_sphere(view, sphere.center, sphere.radius), part_side,
                            4 * bins.block_columns, 4 * block_rows);
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
  return bins;
}

}  // namespace raytracer
