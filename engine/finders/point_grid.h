// Which primitives may stand between a point and a point light, by the cells of the cube around it.
//
// As in a distant light's grid, what is small is kept in the cells themselves ("casters"), and what
// is large is named by them. A cell's entries that reach nearest to the light come first. Behind
// the cells come those that are set aside.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/finders/cell_lists.h"
#include "engine/finders/columns.h"
#include "engine/finders/light_cube.h"

namespace raytracer {

/// Cells of casters, as CasterGrid has them; `nearest`, the least distance from the light, is one
/// of their members.
template <typename Caster, typename T>
struct PointGrid {
  LightCube<T> cube;
  std::vector<std::uint32_t> begins;  ///< of each bin, face by face and row by row, and the end
  CellColumns<T, Caster::members.size()> casters;
  WideEntries wide;  ///< behind those of the cells
};

/// Cells of lists.
template <typename T>
struct PointLists {
  LightCube<T> cube;
  CellLists<T> cells;
};

namespace point_grid {

/// Where the `item`th pair of a primitive and a face comes, the primitives' faces one after
/// another, as PlannedCube::cells() has it: visit(index, box around it) gives the entry. What is
/// not seen through the face comes nowhere.
template <typename Entry, typename T, typename Primitive, typename Visit>
Placed<Entry> place(const PlannedCube<T>& planned, std::span<const Primitive> primitives,
                    std::size_t item, int across, const Visit& visit) {
  const auto face = static_cast<int>(item % cube_faces);
  const std::size_t index = item / cube_faces;
  const unsigned faces = planned.faces[index];
  const bool is_wide = faces == PlannedCube<T>::set_aside;
  if (is_wide ? face != 0 : (faces >> face & 1U) == 0) return {};
  const Primitive seen = seen_from(primitives[index], planned.light);
  const Box box = enlarged(bounds(seen), planned.margin);
  const CellRectangle cells =
      is_wide ? planned.behind_cells(across) : planned.cells(seen, box, face, across);
  if (cells.empty()) return {};
  return {cells, visit(index, box)};
}

}  // namespace point_grid

/// `make(primitive)` gives the caster of one, from several threads. None is farther from the eye
/// than `reach`.
template <typename Caster, typename T, typename Primitive, typename Make>
PointGrid<Caster, T> build_point_grid(const Vec3& light, std::span<const Primitive> primitives,
                                      double reach, const Make& make, WorkerPool& pool) {
  // About as many cells as primitives, but none narrower than twice the mean width, unless crowded.
  constexpr CellWidths widths{.per_primitive = 1, .of_area = 2, .of_side = 0, .most_across = 1024};
  const auto planned = plan_light_cube<T>(light, primitives, reach, widths, pool);
  PointGrid<Caster, T> grid{planned.cube, {}, {}, {}};
  const auto place = [&](std::size_t item) {
    const auto visit = [&](std::size_t index, const Box&) { return make(primitives[index]); };
    return point_grid::place<Caster>(planned, primitives, item, 1, visit);
  };
  const auto entries_of = [](const Caster& caster, const CellRectangle&) {
    return [&caster](int, int) { return caster; };
  };
  const auto arrange = [](std::span<Caster> cell) {
    std::sort(cell.begin(), cell.end(),
              [](const Caster& a, const Caster& b) { return a.nearest < b.nearest; });
  };
  grid.begins = sort_into_bins<Caster>(
      cube_faces * primitives.size(), planned.bins(), pool, place, entries_of, arrange,
      [&](std::size_t count) { grid.casters.resize(count); },
      [&](std::size_t first, std::span<const Caster> cell) {
        grid.casters.write(first, cell, Caster::members);
      });
  grid.wide = planned.wide_entries(grid.begins);
  return grid;
}

/// None is farther from the eye than `reach`. An entry's `top` is less than 0 by its least distance
/// from the light.
template <typename T, typename Primitive>
PointLists<T> build_point_lists(const Vec3& light, std::span<const Primitive> primitives,
                                double reach, WorkerPool& pool) {
  using Entry = cell_lists::Entry<T>;
  // Of six faces, so that single counts all their cells: less than 2^24.
  constexpr CellWidths widths{
      .per_primitive = 1.4, .of_area = 0.8, .of_side = 0.4, .most_across = 1600};
  const auto planned = plan_light_cube<T>(light, primitives, reach, widths, pool);
  const auto place = [&](std::size_t item) {
    const auto visit = [&](std::size_t index, const Box& box) -> Entry {
      constexpr double nearer = 1 - PlannedCube<T>::turn;
      return {{static_cast<T>(-nearer * distance_of(box)), static_cast<std::uint32_t>(index)}, 0};
    };
    return point_grid::place<Entry>(planned, primitives, item, parts_across, visit);
  };
  const auto entries_of = [&](const Entry& whole, const CellRectangle& parts) {
    const int face = parts.y_begin / (parts_across * planned.cube.side);
    const TouchedParts touched(parts, [&] {
      const View& view = planned.views[static_cast<std::size_t>(face)];
      const Primitive seen = seen_from(primitives[whole.caster.primitive], light);
      return planned.against_cells(screen_outline(view, seen), face,
                                   -static_cast<double>(whole.caster.top));
    });
    return [&planned, whole, touched, face](int column, int row) {
      if (face == cube_faces) return whole;  // it is set aside
      const auto [x, y] = planned.pixel(face, column, row);
      Entry entry = whole;
      entry.parts = touched.of_bin(column, row, x, y);
      return entry;
    };
  };
  PointLists<T> lists{planned.cube, list_in_cells<T>(cube_faces * primitives.size(), planned.bins(),
                                                     pool, place, entries_of)};
  lists.cells.wide = planned.wide_entries(lists.cells.begins);
  return lists;
}

}  // namespace raytracer
