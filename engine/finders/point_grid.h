// Which primitives may stand between a point and a point light.
//
// All rays to the light share their end, so a 2-D structure finds what they meet: a cube around the
// light, each of its faces a grid, into whose cells what is round is projected from the light. The
// entries are casters, as in a distant light's grid.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/finders/binning.h"
#include "engine/finders/columns.h"
#include "engine/math/projection.h"
#include "engine/math/view.h"

namespace raytracer {

/// A ball around a primitive.
struct Ball {
  Vec3 center;
  double radius;
};

/// Casters in cells: a face of the cube is numbered 2 * axis, and one more on the negative side;
/// its columns run along the next axis (x to y to z to x), its rows along the one after that. Of a
/// caster's members `nearest` is the least distance from the light.
template <typename Caster, typename T>
struct PointGrid {
  int side = 0;                       ///< cells along a face's side
  std::vector<std::uint32_t> begins;  ///< of each cell, face by face and row by row, and the end
  CellColumns<T, Caster::members.size()>
      casters;  ///< of each cell, those nearest to the light first
};

namespace point_grid {

inline constexpr int faces = 6;

/// A view from the light through a face, a cell to a pixel.
inline View view_of_face(int face, int side) {
  const std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  const auto axis = static_cast<std::size_t>(face / 2);
  const Vec3 forward = face % 2 == 0 ? axes[axis] : -axes[axis];
  // A view's rows run downwards.
  return {forward, axes[(axis + 1) % 3], -axes[(axis + 2) % 3], side, side};
}

/// Whether something in a ball, relative to the light, may reach into a face's pyramid.
inline bool may_reach(const Ball& ball, int face) {
  constexpr double root_two = 1.42;
  const std::array<double, 3> place{ball.center.x, ball.center.y, ball.center.z};
  const auto axis = static_cast<std::size_t>(face / 2);
  const double along = face % 2 == 0 ? place[axis] : -place[axis];
  return along + root_two * ball.radius >=
         std::max(std::abs(place[(axis + 1) % 3]), std::abs(place[(axis + 2) % 3]));
}

/// Cells about as many as primitives, which may all stand on one face, but none narrower than four
/// times the mean radius as the light sees it.
template <typename Primitive>
int cells_across(const Vec3& light, std::span<const Primitive> primitives) {
  constexpr double most = 1024;
  const double count = static_cast<double>(primitives.size());
  double angle2_sum = 0;
  for (const Primitive& primitive : primitives) {
    const Ball ball = bounding_ball(primitive);
    const Vec3 path = ball.center - light;
    angle2_sum += std::min(ball.radius * ball.radius / std::max(dot(path, path), 1e-300), 1.0);
  }
  const double widest = 2 / (4 * std::sqrt(angle2_sum / count) + 1e-300);
  return static_cast<int>(std::clamp(std::min(std::sqrt(count / faces), widest), 1.0, most));
}

}  // namespace point_grid

/// `make(primitive)` gives the caster of one, from several threads.
template <typename Caster, typename T, typename Primitive, typename Make>
PointGrid<Caster, T> build_point_grid(const Vec3& light, std::span<const Primitive> primitives,
                                      const Make& make, WorkerPool& pool) {
  using point_grid::faces;
  PointGrid<Caster, T> grid;
  grid.side = point_grid::cells_across(light, primitives);
  std::vector<Projection> projections;
  projections.reserve(faces);
  for (int face = 0; face < faces; ++face)
    projections.emplace_back(point_grid::view_of_face(face, grid.side));

  // A point finds its cell in precision T: primitives are entered a little beyond their rims.
  const double direction_noise = 64 * static_cast<double>(std::numeric_limits<T>::epsilon());
  const double margin = direction_noise * static_cast<double>(grid.side);
  const double side = static_cast<double>(grid.side);
  const auto place = [&](std::size_t item) -> Placed<Caster> {
    const auto face = static_cast<int>(item % faces);
    const Primitive& primitive = primitives[item / faces];
    Ball ball = bounding_ball(primitive);
    ball.center = ball.center - light;
    if (!point_grid::may_reach({ball.center, ball.radius + direction_noise * length(ball.center)},
                               face))
      return {};
    const PixelRectangle seen =
        projections[static_cast<std::size_t>(face)].of_sphere(ball.center, ball.radius);
    if (!(seen.x_begin < seen.x_end && seen.y_begin < seen.y_end)) return {};
    const auto index = [&](double at) { return static_cast<int>(std::clamp(at, 0.0, side)); };
    CellRectangle cells{index(seen.x_begin - margin), index(seen.y_begin - margin),
                        index(seen.x_end + margin + 1), index(seen.y_end + margin + 1)};
    if (cells.empty()) return {};
    const int row = face * grid.side;
    cells.y_begin += row;
    cells.y_end += row;
    return {cells, make(primitive)};
  };
  const auto entry_in = [](const Caster& caster, const CellRectangle&, int, int) { return caster; };
  const auto arrange = [](std::span<Caster> cell) {
    std::sort(cell.begin(), cell.end(),
              [](const Caster& a, const Caster& b) { return a.nearest < b.nearest; });
  };
  grid.begins = sort_into_bins<Caster>(
      faces * primitives.size(), BinGrid{grid.side, faces * grid.side, 0}, pool, place, entry_in,
      arrange, [&](std::size_t count) { grid.casters.resize(count); },
      [&](std::size_t first, std::span<const Caster> cell) {
        grid.casters.write(first, cell, Caster::members);
      });
  return grid;
}

}  // namespace raytracer
