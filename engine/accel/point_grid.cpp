#include "engine/accel/point_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/accel/binning.h"
#include "engine/accel/lit_sphere.h"
#include "engine/accel/projection.h"
#include "engine/plan/view.h"

namespace raytracer {
namespace {

constexpr int faces = 6;

/// A view from the light through a face, a cell to a pixel.
View view_of_face(int face, int side) {
  const std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  const auto axis = static_cast<std::size_t>(face / 2);
  const Vec3 forward = face % 2 == 0 ? axes[axis] : -axes[axis];
  // A view's rows run downwards.
  return {forward, axes[(axis + 1) % 3], -axes[(axis + 2) % 3], side, side};
}

/// Whether a sphere around `center`, relative to the light, may reach into a face's pyramid.
bool may_reach(const Vec3& center, double radius, int face) {
  constexpr double root_two = 1.42;
  const std::array<double, 3> place{center.x, center.y, center.z};
  const auto axis = static_cast<std::size_t>(face / 2);
  const double along = face % 2 == 0 ? place[axis] : -place[axis];
  return along + root_two * radius >=
         std::max(std::abs(place[(axis + 1) % 3]), std::abs(place[(axis + 2) % 3]));
}

/// Cells about as many as spheres, which may all stand on one face, but none narrower than four
/// times the mean radius as the light sees it.
int cells_across(const Vec3& light, std::span<const PackedSphere> spheres) {
  constexpr double most = 1024;
  const double count = static_cast<double>(spheres.size());
  double angle2_sum = 0;
  for (const PackedSphere& s : spheres) {
    const Vec3 path = s.center - light;
    angle2_sum += std::min(s.radius * s.radius / std::max(dot(path, path), 1e-300), 1.0);
  }
  const double widest = 2 / (4 * std::sqrt(angle2_sum / count) + 1e-300);
  return static_cast<int>(std::clamp(std::min(std::sqrt(count / faces), widest), 1.0, most));
}

}  // namespace

template <typename T>
PointGrid<T> build_point_grid(const Vec3& light, std::span<const PackedSphere> spheres,
                              const Numbering& numbers, WorkerPool& pool) {
  PointGrid<T> grid;
  grid.side = cells_across(light, spheres);
  grid.is_far = is_far_light(light, spheres);
  std::vector<Projection> projections;
  projections.reserve(faces);
  for (int face = 0; face < faces; ++face) projections.emplace_back(view_of_face(face, grid.side));

  // A point finds its cell in precision T: spheres are entered a little beyond their rims.
  const double direction_noise = 64 * static_cast<double>(std::numeric_limits<T>::epsilon());
  const double margin = direction_noise * static_cast<double>(grid.side);
  const double side = static_cast<double>(grid.side);
  struct Entry {
    T x;
    T y;
    T z;
    T radius2;
    T nearest;
    T id;
  };
  const auto place = [&](std::size_t item) -> Placed<Entry> {
    const auto face = static_cast<int>(item % faces);
    const PackedSphere& s = spheres[item / faces];
    const Vec3 c = s.center - light;
    if (!may_reach(c, s.radius + direction_noise * length(c), face)) return {};
    const PixelRectangle seen = projections[static_cast<std::size_t>(face)].of_sphere(c, s.radius);
    if (!(seen.x_begin < seen.x_end && seen.y_begin < seen.y_end)) return {};
    const auto index = [&](double at) { return static_cast<int>(std::clamp(at, 0.0, side)); };
    CellRectangle cells{index(seen.x_begin - margin), index(seen.y_begin - margin),
                        index(seen.x_end + margin + 1), index(seen.y_end + margin + 1)};
    if (cells.empty()) return {};
    const int row = face * grid.side;
    cells.y_begin += row;
    cells.y_end += row;
    const auto lit = LitSphere::seen_from<T>(light, grid.is_far, s);
    return {cells,
            {static_cast<T>(lit.center.x), static_cast<T>(lit.center.y),
             static_cast<T>(lit.center.z), static_cast<T>(lit.radius2),
             static_cast<T>(lit.nearest * (1 - 1e-6)), static_cast<T>(numbers(s.id))}};
  };
  const auto entry_in = [](const Entry& entry, const CellRectangle&, int, int) { return entry; };
  const auto arrange = [](std::span<Entry> entries) {
    std::sort(entries.begin(), entries.end(),
              [](const Entry& a, const Entry& b) { return a.nearest < b.nearest; });
  };
  constexpr Members<Entry, T, PointGrid<T>::column_count> members{
      &Entry::x, &Entry::y, &Entry::z, &Entry::radius2, &Entry::nearest, &Entry::id};
  grid.begins = sort_into_bins(
      faces * spheres.size(), BinGrid{grid.side, faces * grid.side, 0}, pool,
      make_binning<Entry>(place, entry_in, arrange),
      [&](std::size_t count) { grid.spheres.resize(count); },
      [&](std::size_t first, std::span<const Entry> entries) {
        grid.spheres.write(first, entries, members);
      });
  return grid;
}

template PointGrid<float> build_point_grid<float>(const Vec3&, std::span<const PackedSphere>,
                                                  const Numbering&, WorkerPool&);
template PointGrid<double> build_point_grid<double>(const Vec3&, std::span<const PackedSphere>,
                                                    const Numbering&, WorkerPool&);

}  // namespace raytracer
