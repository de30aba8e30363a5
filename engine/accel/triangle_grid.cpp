#include "engine/accel/triangle_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace raytracer {
namespace {

struct Point {
  double u;
  double v;
};

/// The rectangle that a triangle covers as the light sees it.
template <typename T>
struct Extent {
  T u_low, v_low, u_high, v_high;
  T top;  ///< how far it reaches towards the light
};

/// u_slope u + v_slope v + offset is the distance to the line, positive on the inner side.
struct Side {
  double u_slope;
  double v_slope;
  double offset;
};

/// The line from p to q. Of q and p it is the opposite to the bit, so that nothing lies outside of
/// both triangles that share it.
Side side(const Point& p, const Point& q) {
  const double u = q.u - p.u;
  const double v = q.v - p.v;
  const double size = std::sqrt(u * u + v * v);
  const double scale = size > 0 ? 1 / size : 0;
  return {-v * scale, u * scale, (p.u * q.v - p.v * q.u) * scale};
}

/// What all triangles together cover.
struct Spread {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point high{-low.u, -low.v};
  double extents = 0;  ///< of each half the circumference of its rectangle, in sum
  double areas = 0;    ///< of the rectangles, in sum

  void include(const Spread& other) {
    low = {std::min(low.u, other.low.u), std::min(low.v, other.low.v)};
    high = {std::max(high.u, other.high.u), std::max(high.v, other.high.v)};
    extents += other.extents;
    areas += other.areas;
  }
};

/// Fills in a triangle's lines, and returns its extent.
template <typename T>
Extent<T> outline(const std::array<Vec3, 3>& axes, const PackedTriangle& triangle,
                  TriangleOutline<T>& lines) {
  std::array<Point, 3> corners;
  double top = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& corner = triangle.vertices[i];
    corners[i] = {dot(corner, axes[0]), dot(corner, axes[1])};
    top = std::max(top, dot(corner, axes[2]));
  }
  const auto& [a, b, c] = corners;
  const double turn = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
  const double sign = turn < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Side line = side(corners[i], corners[(i + 1) % 3]);
    lines.u_slopes[i] = static_cast<T>(sign * line.u_slope);
    lines.v_slopes[i] = static_cast<T>(sign * line.v_slope);
    lines.offsets[i] = static_cast<T>(sign * line.offset);
  }
  return {static_cast<T>(std::min({a.u, b.u, c.u})), static_cast<T>(std::min({a.v, b.v, c.v})),
          static_cast<T>(std::max({a.u, b.u, c.u})), static_cast<T>(std::max({a.v, b.v, c.v})),
          static_cast<T>(top)};
}

/// Whether a triangle's lines leave it something of the square around (u, v).
template <typename T>
bool reaches(const TriangleOutline<T>& lines, T u, T v, T half) {
  for (std::size_t i = 0; i < 3; ++i)
    if (lines.u_slopes[i] * u + lines.v_slopes[i] * v + lines.offsets[i] +
            (std::abs(lines.u_slopes[i]) + std::abs(lines.v_slopes[i])) * half <
        0)
      return false;
  return true;
}

/// Calls outline() for all triangles. In chunks of a fixed size, so that the sums do not depend on
/// the number of threads.
template <typename T>
Spread outline_all(std::span<const PackedTriangle> triangles, TriangleGrid<T>& grid,
                   LargeArray<Extent<T>>& extents, WorkerPool& pool) {
  constexpr std::size_t chunk_size = 4096;
  std::vector<Spread> spreads((triangles.size() + chunk_size - 1) / chunk_size);
  for_each_chunk(spreads.size(), spreads.size(), pool,
                 [&](std::size_t chunk, std::size_t, std::size_t) {
                   Spread spread;
                   const std::size_t end = std::min(triangles.size(), (chunk + 1) * chunk_size);
                   for (std::size_t i = chunk * chunk_size; i < end; ++i) {
                     const Extent<T> extent = outline(grid.axes, triangles[i], grid.outlines[i]);
                     extents[i] = extent;
                     const double width = extent.u_high - extent.u_low;
                     const double height = extent.v_high - extent.v_low;
                     spread.include({{extent.u_low, extent.v_low},
                                     {extent.u_high, extent.v_high},
                                     width + height,
                                     width * height});
                   }
                   spreads[chunk] = spread;
                 });
  Spread all;
  for (const Spread& spread : spreads) all.include(spread);
  return all;
}

}  // namespace

template <typename T>
TriangleGrid<T> build_triangle_grid(const Vec3& towards, std::span<const PackedTriangle> triangles,
                                    WorkerPool& pool) {
  TriangleGrid<T> grid;
  if (triangles.empty()) return grid;
  const Across plane = across(towards);
  grid.axes = {plane.u, plane.v, towards};
  grid.outlines.resize(triangles.size());
  LargeArray<Extent<T>> extents(triangles.size());
  const Spread spread = outline_all(triangles, grid, extents, pool);

  const double largest = std::max({std::abs(spread.low.u), std::abs(spread.low.v),
                                   std::abs(spread.high.u), std::abs(spread.high.v)});
  grid.noise = 8 * std::numeric_limits<T>::epsilon() * static_cast<T>(largest);

  // Cells about as many as triangles. A triangle of width w and height h is entered into about
  // (w / cell + 1) (h / cell + 1) of them: at most seven on average.
  const auto count = static_cast<double>(triangles.size());
  const double width = spread.high.u - spread.low.u;
  const double height = spread.high.v - spread.low.v;
  const double cell =
      std::max({std::sqrt(width * height / count) * 4, std::sqrt(spread.areas / (3 * count)),
                spread.extents / (3 * count), width / 8192, height / 8192,
                8.0 * static_cast<double>(grid.noise), 1e-30});
  grid.cells_per_unit = static_cast<T>(1 / cell);
  grid.u_low = static_cast<T>(spread.low.u);
  grid.v_low = static_cast<T>(spread.low.v);
  grid.columns = static_cast<int>(width / cell) + 1;
  grid.rows = static_cast<int>(height / cell) + 1;

  const auto index = [&](T offset, int most) {
    return static_cast<int>(std::clamp(offset * grid.cells_per_unit, T(0), static_cast<T>(most)));
  };
  const T margin = 2 * grid.noise;
  const auto side = static_cast<T>(cell);
  const auto place = [&](std::size_t i) {
    const Extent<T>& extent = extents[i];
    return Placed<GridTriangle<T>>{{index(extent.u_low - margin - grid.u_low, grid.columns - 1),
                                    index(extent.v_low - margin - grid.v_low, grid.rows - 1),
                                    index(extent.u_high + margin - grid.u_low + side, grid.columns),
                                    index(extent.v_high + margin - grid.v_low + side, grid.rows)},
                                   {extent.top + grid.noise, static_cast<std::uint32_t>(i)}};
  };
  const auto entry_in = [&](GridTriangle<T> entry, const CellRectangle& cells, int column,
                            int row) {
    if (cells.x_end - cells.x_begin <= 2 || cells.y_end - cells.y_begin <= 2) return entry;
    const T u = grid.u_low + (static_cast<T>(column) + T(0.5)) * side;
    const T v = grid.v_low + (static_cast<T>(row) + T(0.5)) * side;
    // Out of a cell that it does not touch: behind all others, where none looks for it.
    if (!reaches(grid.outlines[entry.triangle], u, v, T(0.501) * side + 4 * grid.noise))
      entry.top = std::numeric_limits<T>::lowest();
    return entry;
  };
  const auto arrange = [](std::span<GridTriangle<T>> entries) {
    std::sort(entries.begin(), entries.end(),
              [](const GridTriangle<T>& a, const GridTriangle<T>& b) { return a.top > b.top; });
  };
  grid.begins = sort_into_bins(
      triangles.size(), BinGrid{grid.columns, grid.rows, 0}, pool,
      make_binning<GridTriangle<T>>(place, entry_in, arrange),
      [&](std::size_t entry_count) { grid.entries.resize(entry_count); },
      [&](std::size_t first, std::span<const GridTriangle<T>> entries) {
        std::copy(entries.begin(), entries.end(),
                  grid.entries.begin() + static_cast<std::ptrdiff_t>(first));
      });
  return grid;
}

template TriangleGrid<float> build_triangle_grid<float>(const Vec3&,
                                                        std::span<const PackedTriangle>,
                                                        WorkerPool&);
template TriangleGrid<double> build_triangle_grid<double>(const Vec3&,
                                                          std::span<const PackedTriangle>,
                                                          WorkerPool&);

}  // namespace raytracer
