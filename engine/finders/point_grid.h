// Which primitives may stand between a point and a point light.
//
// All rays to the light share their end, so a 2-D structure finds what they meet: a cube around the
// light, each of its faces with a grid on the part that primitives are seen through, into whose
// cells what is round is projected from the light. The entries are casters, as in a distant light's
// grid.
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

/// The part of a face that has cells, from (u_low, v_low) on; a face goes from -1 to 1.
template <typename T>
struct FaceWindow {
  T u_low;
  T v_low;
  T columns_per_unit;
  T rows_per_unit;
};

/// Casters in cells: a face of the cube is numbered 2 * axis, and one more on the negative side;
/// its columns run along the next axis (x to y to z to x), its rows along the one after that. Of a
/// caster's members `nearest` is the least distance from the light.
template <typename Caster, typename T>
struct PointGrid {
  int side = 0;  ///< cells along a window's side
  std::array<FaceWindow<T>, 6> windows{};
  std::vector<std::uint32_t> begins;  ///< of each cell, face by face and row by row, and the end
  CellColumns<T, Caster::members.size()>
      casters;  ///< of each cell, those nearest to the light first
};

namespace point_grid {

inline constexpr int faces = 6;

/// What of a face is seen through.
struct Window {
  double u_low = 1;
  double v_low = 1;
  double u_high = -1;
  double v_high = -1;

  bool is_empty() const { return !(u_low < u_high && v_low < v_high); }
  double area() const { return is_empty() ? 0 : (u_high - u_low) * (v_high - v_low); }
  void include(const Window& other) {
    u_low = std::min(u_low, other.u_low);
    v_low = std::min(v_low, other.v_low);
    u_high = std::max(u_high, other.u_high);
    v_high = std::max(v_high, other.v_high);
  }
};

inline constexpr int pixels_across_face = 1 << 14;

/// A view from the light through a face.
inline View view_of_face(int face) {
  const std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  const auto axis = static_cast<std::size_t>(face / 2);
  const Vec3 forward = face % 2 == 0 ? axes[axis] : -axes[axis];
  // A view's rows run downwards.
  return {forward, axes[(axis + 1) % 3], -axes[(axis + 2) % 3], pixels_across_face,
          pixels_across_face};
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

/// Where a ball, relative to the light, may be seen through a face, a little generously.
inline Window window_of(const Ball& ball, int face) {
  if (!may_reach(ball, face)) return {};
  const std::array<double, 3> place{ball.center.x, ball.center.y, ball.center.z};
  const auto axis = static_cast<std::size_t>(face / 2);
  const double along = face % 2 == 0 ? place[axis] : -place[axis];
  const double nearest = along - ball.radius;
  if (!(nearest > 0)) return {-1, -1, 1, 1};
  const auto low = [&](double across) {
    const double least = across - ball.radius;
    return std::clamp(least / (least < 0 ? nearest : along + ball.radius), -1.0, 1.0);
  };
  const auto high = [&](double across) {
    const double most = across + ball.radius;
    return std::clamp(most / (most > 0 ? nearest : along + ball.radius), -1.0, 1.0);
  };
  const double u = place[(axis + 1) % 3];
  const double v = place[(axis + 2) % 3];
  return {low(u), low(v), high(u), high(v)};
}

/// What all primitives are seen through, and `noise` more.
template <typename Primitive>
std::array<Window, faces> windows_of(const Vec3& light, std::span<const Primitive> primitives,
                                     double noise) {
  std::array<Window, faces> windows;
  for (const Primitive& primitive : primitives) {
    Ball ball = bounding_ball(primitive);
    ball.center = ball.center - light;
    for (int face = 0; face < faces; ++face)
      windows[static_cast<std::size_t>(face)].include(window_of(ball, face));
  }
  for (Window& window : windows) {
    if (!(window.u_low <= window.u_high && window.v_low <= window.v_high)) continue;
    window = {window.u_low - noise, window.v_low - noise, window.u_high + noise,
              window.v_high + noise};
  }
  return windows;
}

/// Cells about as many as primitives, which may all stand on one face, but none narrower than four
/// times the mean radius as the light sees it.
template <typename Primitive>
int cells_across(const Vec3& light, std::span<const Primitive> primitives,
                 const std::array<Window, faces>& windows) {
  constexpr double most = 1024;
  const double count = static_cast<double>(primitives.size());
  double angle2_sum = 0;
  for (const Primitive& primitive : primitives) {
    const Ball ball = bounding_ball(primitive);
    const Vec3 path = ball.center - light;
    angle2_sum += std::min(ball.radius * ball.radius / std::max(dot(path, path), 1e-300), 1.0);
  }
  double used = 0;
  double area = 0;
  for (const Window& window : windows) {
    used += window.is_empty() ? 0 : 1;
    area += window.area();
  }
  used = std::max(used, 1.0);
  const double widest = std::sqrt(area / used) / (4 * std::sqrt(angle2_sum / count) + 1e-300);
  return static_cast<int>(std::clamp(std::min(std::sqrt(count / used), widest), 1.0, most));
}

}  // namespace point_grid

/// `make(primitive)` gives the caster of one, from several threads.
template <typename Caster, typename T, typename Primitive, typename Make>
PointGrid<Caster, T> build_point_grid(const Vec3& light, std::span<const Primitive> primitives,
                                      const Make& make, WorkerPool& pool) {
  using point_grid::faces;
  // A point finds its cell in precision T: primitives are entered a little beyond their rims.
  const double direction_noise = 64 * static_cast<double>(std::numeric_limits<T>::epsilon());
  const auto windows = point_grid::windows_of(light, primitives, 4 * direction_noise);
  PointGrid<Caster, T> grid;
  grid.side = point_grid::cells_across(light, primitives, windows);
  std::vector<Projection> projections;
  projections.reserve(faces);
  for (int face = 0; face < faces; ++face) {
    projections.emplace_back(point_grid::view_of_face(face));
    const point_grid::Window& window = windows[static_cast<std::size_t>(face)];
    FaceWindow<T>& cells = grid.windows[static_cast<std::size_t>(face)];
    if (window.is_empty()) {
      cells = {2, 2, 1, 1};  // beyond the face
      continue;
    }
    cells = {static_cast<T>(window.u_low), static_cast<T>(window.v_low),
             static_cast<T>(grid.side / (window.u_high - window.u_low)),
             static_cast<T>(grid.side / (window.v_high - window.v_low))};
  }

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
    const FaceWindow<T>& window = grid.windows[static_cast<std::size_t>(face)];
    const auto index = [&](double pixel, double beyond, T low, T per_unit) {
      const double at = pixel * (2.0 / point_grid::pixels_across_face) - 1 + beyond;
      const double cell = (at - static_cast<double>(low)) * static_cast<double>(per_unit);
      return static_cast<int>(std::clamp(cell + (beyond > 0 ? 1 : 0), 0.0, side));
    };
    CellRectangle cells{
        index(seen.x_begin, -direction_noise, window.u_low, window.columns_per_unit),
        index(seen.y_begin, -direction_noise, window.v_low, window.rows_per_unit),
        index(seen.x_end, direction_noise, window.u_low, window.columns_per_unit),
        index(seen.y_end, direction_noise, window.v_low, window.rows_per_unit)};
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
