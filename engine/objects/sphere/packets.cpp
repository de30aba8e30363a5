// How spheres lie in memory, and what the eye and the lights know of them beforehand.
#include "engine/objects/sphere/packets.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/math/tolerances.h"
#include "engine/packets/padding.h"

namespace raytracer {
namespace {

/// In double up to the last step. A sphere in whose surface the light lies is a little smaller, by
/// what T rounds: it does not hide the light from outside.
template <typename T>
SphereBall<T> ball_seen_from(const Vec3& light, bool is_far, const PackedSphere& sphere,
                             std::int32_t number) {
  constexpr double noise = 1 - nearer_than_light<double>;
  constexpr auto shrink = static_cast<double>(nearer_than_light<T>);
  const Vec3 from_light = sphere.center - light;
  const double distance = length(from_light);
  const bool is_in_surface = std::abs(distance - sphere.radius) <= noise * distance;
  const double radius = is_in_surface ? shrink * distance : sphere.radius;
  const Vec3 center = is_far ? sphere.center : from_light;
  return {static_cast<T>(center.x),
          static_cast<T>(center.y),
          static_cast<T>(center.z),
          static_cast<T>(radius * radius),
          static_cast<T>((distance - radius) * (1 - 1e-6)),
          static_cast<T>(number)};
}

template <typename T>
SphereDisc<T> disc_of(const PackedSphere& s, const LightAxes& axes, std::int32_t number) {
  return {static_cast<T>(dot(s.center, axes[0])), static_cast<T>(dot(s.center, axes[1])),
          static_cast<T>(dot(s.center, axes[2])), static_cast<T>(s.radius * s.radius),
          static_cast<T>(number)};
}

/// All in a single cell.
template <typename Grid, typename Make>
void fill_one_cell(std::span<const PackedSphere> spheres, const Make& make, Grid& grid) {
  std::vector<decltype(make(spheres[0]))> casters;
  casters.reserve(spheres.size());
  for (const PackedSphere& sphere : spheres) casters.push_back(make(sphere));
  using Caster = typename decltype(casters)::value_type;
  grid.begins = {0, static_cast<std::uint32_t>(casters.size())};
  grid.casters.resize(casters.size());
  grid.casters.write(0, std::span<const Caster>(casters), Caster::members);
}

/// Every third bit of a number of seven.
std::uint32_t spread_bits(std::uint32_t x) {
  std::uint32_t spread = 0;
  for (unsigned bit = 0; bit < 7; ++bit) spread |= (x >> bit & 1U) << (3 * bit);
  return spread;
}

/// Places of the spheres in such an order that those near each other in space are near each other:
/// along Morton's curve through the cells of a cube.
std::vector<std::uint32_t> order_in_space(std::span<const PackedSphere> spheres, const Box& box,
                                          WorkerPool& pool) {
  constexpr double few_across = 8;
  constexpr double most_across = 128;
  const double across = std::clamp(
      std::exp2(std::floor(std::log2(std::cbrt(static_cast<double>(spheres.size()) / 4)))),
      few_across, most_across);
  const Vec3 size = box.high - box.low;
  const double side = std::max(max_abs(size), 1e-300);
  const auto cell_of = [&](const PackedSphere& sphere) {
    const Vec3 at = (across / side) * (sphere.center - box.low);
    const auto along = [&](double x) {
      return spread_bits(static_cast<std::uint32_t>(std::clamp(x, 0.0, across - 1)));
    };
    return along(at.x) | along(at.y) << 1U | along(at.z) << 2U;
  };
  const auto cells = static_cast<std::size_t>(across * across * across);
  std::vector<std::uint32_t> next(cells + 1, 0);
  std::vector<std::uint32_t> cell(spheres.size());
  for_each_range(spheres.size(), pool, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) cell[i] = cell_of(spheres[i]);
  });
  std::vector<std::uint32_t> order(spheres.size());
  // A few threads each those of some cells: they look at all spheres, which takes little.
  constexpr std::size_t most_threads = 8;
  const std::size_t parts =
      spheres.size() < few_items ? 1 : std::min(pool.thread_count(), most_threads);
  const auto for_each_by_cell = [&](const auto& visit) {
    for_each_chunk(cells, parts, pool, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = 0; i < cell.size(); ++i)
        if (cell[i] - begin < end - begin) visit(i);
    });
  };
  for_each_by_cell([&](std::size_t i) { ++next[cell[i] + 1]; });
  for (std::size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
  for_each_by_cell([&](std::size_t i) { order[next[cell[i]]++] = static_cast<std::uint32_t>(i); });
  return order;
}

}  // namespace

template <typename T>
SphereColumns<T> PacketLayout<SphereKind, T>::swept(std::span<const PackedSphere> spheres,
                                                    const Numbering& numbers, WorkerPool& pool) {
  using Columns = SphereColumns<T>;
  Columns columns;
  for (auto& column : columns.values) column.resize(spheres.size() + packet_padding);
  Box box;
  for (const PackedSphere& sphere : spheres) box.include(bounds(sphere));
  columns.box = {narrowed<T>(box.low), narrowed<T>(box.high)};
  const std::vector<std::uint32_t> order = order_in_space(spheres, box, pool);
  columns.blocks.resize((spheres.size() + Columns::in_block - 1) / Columns::in_block);
  for_each_range(columns.blocks.size(), pool, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const std::size_t last = std::min((block + 1) * Columns::in_block, spheres.size());
      Box around;
      for (std::size_t i = block * Columns::in_block; i < last; ++i)
        around.include(bounds(spheres[order[i]]));
      columns.blocks[block] = {narrowed<T>(around.low), narrowed<T>(around.high)};
    }
  });
  for_each_range(spheres.size(), pool, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const PackedSphere& sphere = spheres[order[i]];
      const Triple<T> center = narrowed<T>(sphere.center);
      columns.values[Columns::column_x][i] = center.x;
      columns.values[Columns::column_y][i] = center.y;
      columns.values[Columns::column_z][i] = center.z;
      columns.values[Columns::column_radius][i] = static_cast<T>(sphere.radius);
      columns.values[Columns::column_radius2][i] = static_cast<T>(sphere.radius * sphere.radius);
      columns.values[Columns::column_id][i] = static_cast<T>(numbers(sphere.id));
    }
  });
  return columns;
}

template <typename T>
SphereLightView<T> PacketLayout<SphereKind, T>::light_view(std::span<const PackedSphere> spheres,
                                                           const PackedLight& light,
                                                           const FinderRow& finders,
                                                           const Numbering& numbers,
                                                           WorkerPool& pool) {
  SphereLightView<T> view;
  if (light.is_opposite) return view;  // the other end's serves both
  if (light.rays == LightRays::parallel) {
    const auto make = [&numbers](const PackedSphere& s, const LightAxes& axes) {
      return disc_of<T>(s, axes, numbers(s.id));
    };
    const Finder finder = finder_of(finders, ray_kind_of(light));
    if (finder == Finder::light_grid) {
      view.discs = build_caster_grid<SphereDisc<T>, T>(light.place, spheres, make, pool);
    } else if (finder == Finder::one_by_one) {
      const LightAxes axes = light_axes(light.place);
      view.discs.plane.axes = in_precision<T>(axes);
      fill_one_cell(
          spheres, [&](const PackedSphere& s) { return make(s, axes); }, view.discs);
    }
    return view;
  }
  const double reach = reach_of(spheres, pool);
  view.is_far = is_far_light(light.place, reach);
  const auto make = [&, is_far = view.is_far](const PackedSphere& s) {
    return ball_seen_from<T>(light.place, is_far, s, numbers(s.id));
  };
  if (finder_of(finders, RayKind::to_point_light) == Finder::point_grid)
    view.balls = build_point_grid<SphereBall<T>, T>(light.place, spheres, reach, make, pool);
  else if (finder_of(finders, RayKind::to_point_light) == Finder::one_by_one)
    fill_one_cell(spheres, make, view.balls);
  return view;
}

template struct PacketLayout<SphereKind, float>;
template struct PacketLayout<SphereKind, double>;

}  // namespace raytracer
