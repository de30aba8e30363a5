// Which primitives may stand between a point and a distant light: grids on the plane across it.
//
// What is small is kept in the cells themselves, in columns of the kernels' precision, ready to be
// tested many at a time ("casters"); what is large is named by them. A cell's entries that reach
// nearest to the light come first.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/finders/cell_lists.h"
#include "engine/finders/columns.h"
#include "engine/finders/light_plane.h"

namespace raytracer {

/// Cells of casters, structures whose members are all T and named by Caster::members; `w`, how far
/// its middle is towards the light, is one of them.
template <typename Caster, typename T>
struct CasterGrid {
  /// A cell of so few is not in order: a packet or two test them all.
  static constexpr std::size_t few = 32;

  LightPlane<T> plane;
  std::vector<std::uint32_t> begins;  ///< of each cell, row by row, and the end of the last
  CellColumns<T, Caster::members.size()> casters;
};

/// `make(primitive, axes)` gives the caster of one, from several threads.
template <typename Caster, typename T, typename Primitive, typename Make>
CasterGrid<Caster, T> build_caster_grid(const Vec3& towards, std::span<const Primitive> primitives,
                                        const Make& make, WorkerPool& pool) {
  // Cells for about four casters, but none smaller than twice the mean width: then there are some
  // two entries for each caster, and a packet still tests a whole cell at once. Random spheres,
  // against half that width: 250,000 build in 0.85 of the time and trace in 0.65.
  constexpr CellWidths widths{.per_primitive = 2, .of_area = 2, .of_side = 0, .most_across = 4096};
  const auto planned = plan_light_plane<T>(towards, primitives, widths, pool);
  CasterGrid<Caster, T> grid{planned.plane, {}, {}};
  const auto place = [&primitives, &make, planned](std::size_t i) {
    const LightAxes& axes = planned.axes;
    return Placed<Caster>{planned.cells(shadow_extent(primitives[i], axes)),
                          make(primitives[i], axes)};
  };
  const auto entries_of = [](const Caster& caster, const CellRectangle&) {
    return [&caster](int, int) { return caster; };
  };
  const auto arrange = [](std::span<Caster> cell) {
    if (cell.size() > CasterGrid<Caster, T>::few)
      std::sort(cell.begin(), cell.end(),
                [](const Caster& a, const Caster& b) { return a.w > b.w; });
  };
  grid.begins = sort_into_bins<Caster>(
      primitives.size(), BinGrid{grid.plane.columns, grid.plane.rows, 0}, pool, place, entries_of,
      arrange, [&](std::size_t count) { grid.casters.resize(count); },
      [&](std::size_t first, std::span<const Caster> cell) {
        grid.casters.write(first, cell, Caster::members);
      });
  return grid;
}

/// Cells of lists.
template <typename T>
struct ListGrid {
  LightPlane<T> plane;
  CellLists<T> cells;
};

/// `touches(primitive, u, v, half)` says whether one may cover something of the square around (u,
/// v) if its rectangle does; it is called from several threads.
template <typename T, typename Primitive, typename Touches>
ListGrid<T> build_list_grid(const Vec3& towards, std::span<const Primitive> primitives,
                            const Touches& touches, WorkerPool& pool) {
  using Entry = ListedCaster<T>;
  // One of width w and height h is entered into about (w / cell + 1) (h / cell + 1) cells: at most
  // seven on average.
  constexpr CellWidths widths{
      .per_primitive = 4, .of_area = 0.577, .of_side = 1.0 / 3, .most_across = 8192};
  const auto planned = plan_light_plane<T>(towards, primitives, widths, pool);
  const auto place = [&primitives, planned](std::size_t i) {
    const ShadowExtent extent = shadow_extent(primitives[i], planned.axes);
    return Placed<Entry>{
        planned.cells(extent),
        {static_cast<T>(extent.top) + planned.plane.noise, static_cast<std::uint32_t>(i)}};
  };
  const auto entries_of = [&](const Entry& whole, const CellRectangle& cells) {
    const bool is_small = cells.x_end - cells.x_begin <= 2 || cells.y_end - cells.y_begin <= 2;
    return [&, is_small](int column, int row) {
      Entry entry = whole;
      const double u = planned.u_low + (column + 0.5) * planned.cell;
      const double v = planned.v_low + (row + 0.5) * planned.cell;
      if (!is_small && !touches(entry.primitive, static_cast<T>(u), static_cast<T>(v),
                                static_cast<T>(0.501 * planned.cell + planned.margin)))
        entry.top = Entry::nowhere;
      return entry;
    };
  };
  return {planned.plane,
          list_in_cells<T>(primitives.size(), BinGrid{planned.plane.columns, planned.plane.rows, 0},
                           pool, place, entries_of)};
}

}  // namespace raytracer
