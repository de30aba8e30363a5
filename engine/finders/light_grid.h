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
  std::vector<std::uint32_t> begins;  ///< of each bin, row by row, and the end of the last
  CellColumns<T, Caster::members.size()> casters;
  WideEntries wide;  ///< behind those of the cells
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
  CasterGrid<Caster, T> grid{planned.plane, {}, {}, {}};
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
      primitives.size(), planned.bins(), pool, place, entries_of, arrange,
      [&](std::size_t count) { grid.casters.resize(count); },
      [&](std::size_t first, std::span<const Caster> cell) {
        grid.casters.write(first, cell, Caster::members);
      });
  grid.wide = planned.wide_entries(grid.begins);
  return grid;
}

/// Cells of lists.
template <typename T>
struct ListGrid {
  LightPlane<T> plane;
  CellLists<T> cells;
};

/// outline_of(i) says between which lines the light sees primitive i; it is called from several
/// threads.
template <typename T, typename Primitive, typename OutlineOf>
ListGrid<T> build_list_grid(const Vec3& towards, std::span<const Primitive> primitives,
                            const OutlineOf& outline_of, WorkerPool& pool) {
  using Entry = cell_lists::Entry<T>;
  // One of width w and height h is entered into about (w / cell + 1) (h / cell + 1) cells, a few on
  // average. Half as wide cells trace a few percent faster, and take longer to fill.
  constexpr CellWidths widths{
      .per_primitive = 8, .of_area = 1.15, .of_side = 2.0 / 3, .most_across = 8192};
  const auto planned = plan_light_plane<T>(towards, primitives, widths, pool);
  const auto place = [&primitives, planned](std::size_t i) -> Placed<Entry> {
    const ShadowExtent extent = shadow_extent(primitives[i], planned.axes);
    const T top = static_cast<T>(extent.top) + planned.plane.noise;
    return {planned.cells(extent, parts_across), {{top, static_cast<std::uint32_t>(i)}, 0}};
  };
  const auto entries_of = [&](const Entry& whole, const CellRectangle& parts) {
    const TouchedParts touched(
        parts, [&] { return planned.against_cells(outline_of(whole.caster.primitive)); });
    return [&planned, whole, touched](int column, int row) {
      Entry entry = whole;
      entry.parts = touched.of_bin(column, row, planned.u_begin(column), planned.v_begin(row));
      return entry;
    };
  };
  ListGrid<T> grid{planned.plane,
                   list_in_cells<T>(primitives.size(), planned.bins(), pool, place, entries_of)};
  grid.cells.wide = planned.wide_entries(grid.cells.begins);
  return grid;
}

}  // namespace raytracer
