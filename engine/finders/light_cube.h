// The cube around a point light, cut into cells.
//
// All rays to the light end there: what may stand before a point is what is seen from the light in
// the point's direction. So each face of the cube is an image that the light sees, and every
// primitive is entered into the cells of it that its footprint may touch, as into the blocks of the
// eye's, or set aside where it is far wider than the others. A face has cells where primitives are
// seen through it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/finders/binning.h"
#include "engine/finders/light_plane.h"
#include "engine/finders/seen_faces.h"
#include "engine/finders/wide_primitives.h"
#include "engine/math/projection.h"
#include "engine/math/tolerances.h"
#include "engine/math/triple.h"
#include "engine/math/view.h"
#include "engine/memory/page_allocator.h"
#include "engine/parallel/sum.h"

namespace raytracer {

/// Where a face's cells begin: at (u, v) of its own from -1 to 1, as a point p looks for it. From
/// the light l, along the face's axis w, p is seen at u = (p_u - l_u) / |p_w - l_w|, which is
/// beyond a begin b by (p_u - slope p_w - start) / |p_w - l_w|, with slope = +-b and start = l_u -
/// slope l_w: however far away the light is, what is subtracted is no larger than the scene. To a
/// light that is not far p is relative, and no start is left.
template <typename T>
struct CubeFace {
  T u_slope;
  T v_slope;
  T u_start;
  T v_start;
};

/// Cells, in the precision in which points look for theirs. A face is numbered 2 * axis, and one
/// more on the negative side; its columns run along the next axis (x to y to z to x), its rows
/// along the one after that.
template <typename T>
struct LightCube {
  std::array<CubeFace<T>, cube_faces> faces{};
  T cells_per_unit{};
  int side = 0;         ///< of a face, in cells
  bool is_far = false;  ///< the light: places are relative to the eye, and not to it

  BinGrid cells() const { return {side, cube_faces * side, 0}; }
};

/// How far from the eye any of them reaches.
template <typename Primitive>
double reach_of(std::span<const Primitive> primitives, WorkerPool& pool) {
  const std::size_t chunk_count = primitives.size() < few_items ? 1 : pool.thread_count();
  std::vector<double> farthest(chunk_count);
  for_each_chunk(primitives.size(), chunk_count, pool,
                 [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                   double own = 0;
                   for (const Primitive& primitive : primitives.subspan(begin, end - begin)) {
                     const Box box = bounds(primitive);
                     own = std::max({own, max_abs(box.low), max_abs(box.high)});
                   }
                   farthest[chunk] = own;
                 });
  return *std::max_element(farthest.begin(), farthest.end());
}

namespace light_cube {

/// So many that no margin of a projection counts.
inline constexpr int pixels_across_face = 1 << 30;

inline constexpr double pixels_across_unit = 0.5 * pixels_across_face;

inline double pixel_of(double place) { return (place + 1) * pixels_across_unit; }
inline double place_of(double pixel) { return pixel * (2.0 / pixels_across_face) - 1; }

/// The view from the light through a face.
inline View view_of_face(int face) {
  const std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  const auto axis = static_cast<std::size_t>(face / 2);
  const Vec3 forward = face % 2 == 0 ? axes[axis] : -axes[axis];
  // A view's rows run downwards.
  return {forward, axes[(axis + 1) % 3], -axes[(axis + 2) % 3], pixels_across_face,
          pixels_across_face};
}

}  // namespace light_cube

/// Where cells begin and how wide they are, in double; and who is seen through which face.
template <typename T>
struct PlannedCube {
  /// What directions are rounded by, as shares of what they differ by.
  static constexpr double turn = 64 * static_cast<double>(std::numeric_limits<T>::epsilon());
  /// That a primitive is wide, and in no cell.
  static constexpr unsigned set_aside = 1U << cube_faces;

  LightCube<T> cube;
  Vec3 light;
  double margin;  ///< by which primitives are enlarged: a point finds its cell in T
  std::array<FaceRectangle, cube_faces> windows;
  LargeArray<std::uint8_t> faces;  ///< of each primitive, a bit for each face, or set_aside
  bool has_wide;
  std::array<View, cube_faces> views;
  std::vector<Projection> projections;  ///< of the views

  /// The cube's cells and, if something is set aside, one more row, of which that has the first.
  BinGrid bins() const {
    const BinGrid cells = cube.cells();
    return {cells.columns, cells.rows + (has_wide ? 1 : 0), 0};
  }
  /// There, as cells() counts.
  CellRectangle behind_cells(int across) const {
    const int row = across * cube.cells().rows;
    return {0, row, 1, row + 1};
  }
  WideEntries wide_entries(const std::vector<std::uint32_t>& begins) const {
    return entries_behind(begins, cube.cells().bin_count());
  }

  /// Where something comes on a face that is `seen` from the light, in that box: in cells or, of
  /// cells cut into `across` x `across` parts, in those.
  template <typename Primitive>
  CellRectangle cells(const Primitive& seen, const Box& box, int face, int across) const {
    const auto of = static_cast<std::size_t>(face);
    const PixelRectangle pixels = footprint(projections[of], seen);
    if (!(pixels.x_begin < pixels.x_end && pixels.y_begin < pixels.y_end)) return {};
    const BoxInFace outer(box, face);
    const FaceRectangle most = outer.rectangle(turn);
    const FaceRectangle& window = windows[of];
    const double wider = wider_by(outer.least_along());
    const int side = across * cube.side;
    const auto index = [&](double place, int more) {
      const double cell = place * static_cast<double>(cube.cells_per_unit) * across + more;
      return static_cast<int>(std::clamp(cell, 0.0, static_cast<double>(side)));
    };
    const double u_wider = wider + turn * window.width();
    const double v_wider = wider + turn * window.height();
    using light_cube::place_of;
    const int row = face * side;
    return {index(std::max(place_of(pixels.x_begin) - u_wider, most.u_low) - window.u_low, 0),
            row + index(std::max(place_of(pixels.y_begin) - v_wider, most.v_low) - window.v_low, 0),
            index(std::min(place_of(pixels.x_end) + u_wider, most.u_high) - window.u_low, 1),
            row + index(std::min(place_of(pixels.y_end) + v_wider, most.v_high) - window.v_low, 1)};
  }

  /// The outline of something in a face's view that is so far from the light or farther, against
  /// cells, generous by how much more of the view may belong to those.
  template <std::size_t count>
  PartOutline<count> against_cells(const std::array<Line, count>& outline, int face,
                                   double distance) const {
    const FaceRectangle& window = windows[static_cast<std::size_t>(face)];
    const double cell = 1 / static_cast<double>(cube.cells_per_unit);
    const double wider = outline_noise * cell + wider_by(distance / light_cube::root_three) +
                         turn * std::max(window.width(), window.height());
    using light_cube::pixels_across_unit;
    return {outline, cell * pixels_across_unit, cell * pixels_across_unit,
            wider * pixels_across_unit + projection_margin_px};
  }
  /// Where in the face's view a cell begins, in rows as `cells` counts them.
  std::array<double, 2> pixel(int face, int column, int row) const {
    const FaceRectangle& window = windows[static_cast<std::size_t>(face)];
    const double cell = 1 / static_cast<double>(cube.cells_per_unit);
    return {light_cube::pixel_of(window.u_low + column * cell),
            light_cube::pixel_of(window.v_low + (row - face * cube.side) * cell)};
  }

  /// By how much of a face a point may miss its cell, so far along the face's axis.
  double wider_by(double along) const {
    constexpr double all = 4;
    const double wider = margin / along;
    return wider < all ? wider : all;  // all too where it is no number
  }
};

/// Cells that suit the primitives, at least one of which there is, none of them farther from the
/// eye than `reach`; bounds() and seen_from() are called from several threads.
template <typename T, typename Primitive>
PlannedCube<T> plan_light_cube(const Vec3& light, std::span<const Primitive> primitives,
                               double reach, const CellWidths& widths, WorkerPool& pool) {
  constexpr double turn = PlannedCube<T>::turn;
  // Boxes are taken relative to the light, from whose distance double keeps so much of a place.
  const double rounded = 32 * std::numeric_limits<double>::epsilon() * length(light);
  PlannedCube<T> planned{{}, light, turn * reach + rounded, {}, {}, false, {}, {}};
  planned.faces.resize(primitives.size());
  using ByWidth = SpreadsByWidth<light_cube::Seen>;
  LargeArray<std::uint8_t> widths_of(primitives.size());  // as ByWidth counts them
  const auto by_width = sum_in_parts<ByWidth>(
      primitives.size(), &pool, [&](std::size_t begin, std::size_t end, ByWidth& sum) {
        for (std::size_t i = begin; i < end; ++i) {
          const Box box = enlarged(bounds(seen_from(primitives[i], light)), planned.margin);
          const light_cube::SeenBox seen(box, turn);
          const std::size_t width = ByWidth::index_of(seen.width());
          sum.spreads[width].include(seen);
          planned.faces[i] = static_cast<std::uint8_t>(seen.faces);
          widths_of[i] = static_cast<std::uint8_t>(width);
        }
      });
  const auto entered = without_wide(by_width, [&](const light_cube::Seen& seen) {
    return light_cube::cell_width<T>(seen, widths);
  });
  planned.has_wide = entered.has_wide();
  if (planned.has_wide)
    for_each_range(primitives.size(), pool, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        if (widths_of[i] >= entered.wide_from) planned.faces[i] = PlannedCube<T>::set_aside;
    });

  planned.windows = light_cube::windows_of<T>(entered.spread);
  const double cell = light_cube::cell_width<T>(entered.spread, widths);
  planned.cube.cells_per_unit = static_cast<T>(1 / cell);
  planned.cube.side = static_cast<int>(light_cube::widest_of(planned.windows) / cell) + 1;
  planned.cube.is_far = is_far_light(light, reach);
  for (int i = 0; i < cube_faces; ++i) {
    const auto face = static_cast<std::size_t>(i);
    const int axis = i / 2;
    const double sign = i % 2 == 0 ? 1 : -1;
    const FaceRectangle& window = planned.windows[face];
    const double along = component(light, axis);
    const auto start = [&](int across, double slope) {
      const double from_eye = component(light, across % 3) - slope * along;
      return static_cast<T>(planned.cube.is_far ? from_eye : 0);
    };
    planned.cube.faces[face] = {
        static_cast<T>(sign * window.u_low), static_cast<T>(sign * window.v_low),
        start(axis + 1, sign * window.u_low), start(axis + 2, sign * window.v_low)};
    planned.views[face] = light_cube::view_of_face(i);
    planned.projections.emplace_back(planned.views[face]);
  }
  return planned;
}

}  // namespace raytracer
