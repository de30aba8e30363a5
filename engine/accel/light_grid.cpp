#include "engine/accel/light_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/accel/binning.h"

namespace raytracer {
namespace {

/// Longer than any packet.
constexpr std::size_t padding = 64;

/// A sphere in the light's coordinates.
struct Disc {
  double u;
  double v;
  double w;
};

struct Bounds {
  double u_low = std::numeric_limits<double>::infinity();
  double v_low = std::numeric_limits<double>::infinity();
  double u_high = -std::numeric_limits<double>::infinity();
  double v_high = -std::numeric_limits<double>::infinity();
  double radius2_sum = 0;
};

struct Cells {
  int column_begin;
  int row_begin;
  int column_end;  ///< inclusive
  int row_end;     ///< inclusive
};

}  // namespace

template <typename T>
DistantGrid<T> build_distant_grid(const Vec3& towards, const std::vector<PackedSphere>& spheres,
                                  const std::vector<std::int32_t>& ids, WorkerPool& pool) {
  DistantGrid<T> grid{};
  const Across plane = across(towards);
  grid.axes = {plane.u, plane.v, towards};
  const auto place = [&](const PackedSphere& s) {
    return Disc{dot(s.center, grid.axes[0]), dot(s.center, grid.axes[1]),
                dot(s.center, grid.axes[2])};
  };
  Bounds bounds;
  for (const PackedSphere& s : spheres) {
    const Disc disc = place(s);
    bounds.u_low = std::min(bounds.u_low, disc.u - s.radius);
    bounds.v_low = std::min(bounds.v_low, disc.v - s.radius);
    bounds.u_high = std::max(bounds.u_high, disc.u + s.radius);
    bounds.v_high = std::max(bounds.v_high, disc.v + s.radius);
    bounds.radius2_sum += s.radius * s.radius;
  }
  // Cells about as many as spheres, but none smaller than twice the discs' mean radius, so that
  // there are at most some four entries for each disc.
  const double count = static_cast<double>(spheres.size());
  const double width = bounds.u_high - bounds.u_low;
  const double height = bounds.v_high - bounds.v_low;
  const double cell =
      std::max({std::sqrt(width * height / count), 2 * std::sqrt(bounds.radius2_sum / count),
                width / 8192, height / 8192});
  grid.cells_per_unit = static_cast<T>(1 / cell);
  grid.u_low = static_cast<T>(bounds.u_low);
  grid.v_low = static_cast<T>(bounds.v_low);
  grid.columns = static_cast<int>(width / cell) + 1;
  grid.rows = static_cast<int>(height / cell) + 1;

  // A disc is entered a little beyond its rim, because a point finds its cell in precision T.
  const double margin = 64 * static_cast<double>(std::numeric_limits<T>::epsilon()) *
                        std::max({std::abs(bounds.u_low), std::abs(bounds.v_low),
                                  std::abs(bounds.u_high), std::abs(bounds.v_high)});
  const auto cells_of = [&](const Disc& disc, double radius) {
    const double reach = radius + margin;
    const auto index = [&](double offset, int cells) {
      return std::clamp(static_cast<int>(std::floor(offset / cell)), 0, cells - 1);
    };
    return Cells{index(disc.u - reach - bounds.u_low, grid.columns),
                 index(disc.v - reach - bounds.v_low, grid.rows),
                 index(disc.u + reach - bounds.u_low, grid.columns),
                 index(disc.v + reach - bounds.v_low, grid.rows)};
  };

  struct Entry {
    T u;
    T v;
    T w;
    T radius2;
    T id;
  };
  const std::size_t cell_count =
      static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
  Binned<Entry> discs =
      sort_into_bins<Entry>(spheres.size(), cell_count, pool, [&](std::size_t i, auto emit) {
        const PackedSphere& s = spheres[i];
        const Disc disc = place(s);
        const Cells cells = cells_of(disc, s.radius);
        const Entry entry{static_cast<T>(disc.u), static_cast<T>(disc.v), static_cast<T>(disc.w),
                          static_cast<T>(s.radius * s.radius), static_cast<T>(ids[i])};
        for (int row = cells.row_begin; row <= cells.row_end; ++row)
          for (int column = cells.column_begin; column <= cells.column_end; ++column)
            emit(static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
                     static_cast<std::size_t>(column),
                 entry);
      });
  for (std::vector<T>* column : {&grid.u, &grid.v, &grid.radius2, &grid.w, &grid.id})
    column->resize(discs.entries.size() + padding);
  sort_bins(
      discs, pool, [](const Entry& a, const Entry& b) { return a.w > b.w; },
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = discs.begins[begin]; i < discs.begins[end]; ++i) {
          const Entry& entry = discs.entries[i];
          grid.u[i] = entry.u;
          grid.v[i] = entry.v;
          grid.w[i] = entry.w;
          grid.radius2[i] = entry.radius2;
          grid.id[i] = entry.id;
        }
      });
  grid.begins = std::move(discs.begins);
  return grid;
}

template DistantGrid<float> build_distant_grid<float>(const Vec3&, const std::vector<PackedSphere>&,
                                                      const std::vector<std::int32_t>&,
                                                      WorkerPool&);
template DistantGrid<double> build_distant_grid<double>(const Vec3&,
                                                        const std::vector<PackedSphere>&,
                                                        const std::vector<std::int32_t>&,
                                                        WorkerPool&);

}  // namespace raytracer
