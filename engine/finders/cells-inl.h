// Casters in the cells of a grid, against the points that are in them.

#include <hwy/cache_control.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "engine/finders/cell_lists.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Whether testing `entry_count` casters against a whole packet costs less than testing one point
/// after another of `lane_count` against a packet of casters.
HWY_INLINE bool suits_packet(std::size_t entry_count, std::size_t lane_count, std::size_t lanes) {
  return entry_count <= lane_count * ((entry_count + lanes - 1) / lanes);
}

/// Visits the entries of each lane's cell, for the lanes of `rest`; cell i's entries begin at
/// `begins[i]`. Calls `test_together(begin, end, lanes)`, to test each entry against all `lanes`,
/// which may be more than those of `rest`, or `test_alone(begin, end, lane)`, to test the one lane
/// against a packet of entries after another, whichever costs less.
template <class D, class Begins, class Together, class Alone, class V = hn::Vec<D>,
          class M = hn::Mask<D>>
HWY_INLINE void for_each_cell(D d, const Begins& begins, V cell, M rest,
                              const Together& test_together, const Alone& test_alone) {
  using T = hn::TFromD<D>;
  constexpr std::size_t most_lanes = hn::MaxLanes(D());
  HWY_ALIGN T cells[most_lanes];
  hn::Store(cell, d, cells);
  std::uint64_t lanes_left = bits_of(d, rest);
  while (lanes_left != 0) {
    const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero64(lanes_left);
    const auto index = static_cast<std::uint32_t>(cells[lane]);
    const std::size_t begin = begins[index];
    const std::size_t end = begins[index + 1];
    const M equal = hn::Eq(cell, hn::Set(d, cells[lane]));
    const std::uint64_t together = bits_of(d, equal) & lanes_left;
    if (suits_packet(end - begin, hwy::PopCount(together), most_lanes)) {
      test_together(begin, end, equal);
      lanes_left &= ~together;
    } else {
      test_alone(begin, end, lane);
      lanes_left &= lanes_left - 1;
    }
  }
}

/// Asks the memory for each lane's cell, for the lanes of `rest`: whole if it has few entries, else
/// for its first lines.
template <class D, class Grid, class Columns, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE void fetch_cells(D d, const Grid& grid, const Columns& columns, V cell, M rest) {
  using T = hn::TFromD<D>;
  constexpr std::size_t line = 64 / sizeof(T);
  constexpr std::size_t most = 6 * line;
  HWY_ALIGN T cells[hn::MaxLanes(D())];
  hn::Store(cell, d, cells);
  auto fetched = std::numeric_limits<std::uint32_t>::max();
  for (std::uint64_t left = bits_of(d, rest); left != 0; left &= left - 1) {
    const auto index = static_cast<std::uint32_t>(cells[hwy::Num0BitsBelowLS1Bit_Nonzero64(left)]);
    if (index == fetched) continue;  // as neighbours often are
    fetched = index;
    const T* const begin = columns.cell(grid.begins[index]);
    const auto count = static_cast<std::size_t>(columns.cell(grid.begins[index + 1]) - begin);
    for (std::size_t at = 0; at < std::min(count, most); at += line) hwy::Prefetch(begin + at);
  }
}

/// Lanes whose light one of a cell's `count` casters (of shadows) hides, tried by all lanes.
/// `test(d, get, values)` compares casters with points, of which `values` hold what it asks for.
template <class D, class Test, class V, std::size_t size, typename T = hn::TFromD<D>>
HWY_INLINE hn::Mask<D> occluded_by_each(D d, const T* cell, std::size_t count, const Test& test,
                                        const V (&values)[size]) {
  auto dark = hn::Lt(values[0], values[0]);
  for (std::size_t i = 0; i < count; ++i)
    dark = hn::Or(
        dark,
        test(
            d, [&](std::size_t column) HWY_ATTR { return hn::Set(d, cell[column * count + i]); },
            values));
  return dark;
}

/// Lanes of `lit` whose light a caster that is set aside hides.
template <class D, class Grid, class Test, class V, std::size_t size, class M = hn::Mask<D>>
HWY_INLINE M occluded_by_wide(D d, const Grid& grid, const Test& test, const V (&values)[size],
                              M lit) {
  if (hn::AllFalse(d, lit)) return lit;
  return hn::And(
      lit, occluded_by_each(d, grid.casters.cell(grid.wide.begin), grid.wide.count, test, values));
}

/// Lanes of `lit` whose light a caster of their own cell hides. test.is_past(d, cell, count, i,
/// values) says for which points a cell's caster i, and all behind it, are past what may hide them.
template <class D, class Grid, class Test, class V, std::size_t size, class M = hn::Mask<D>>
HWY_NOINLINE M occluded_in_cells(D d, const Grid& grid, V cell_of_lane, const Test& test,
                                 const V (&values)[size], M lit) {
  using T = hn::TFromD<D>;
  constexpr std::size_t most_lanes = hn::MaxLanes(D());
  HWY_ALIGN T stored[size][most_lanes];
  for (std::size_t i = 0; i < size; ++i) hn::Store(values[i], d, stored[i]);
  constexpr std::size_t often = 8;  // it is asked whether a cell's other casters matter
  M dark = hn::Lt(values[0], values[0]);
  std::uint64_t dark_alone = 0;
  const auto test_together = [&](std::size_t begin, std::size_t end, M lanes) HWY_ATTR {
    const T* const cell = grid.casters.cell(begin);
    const std::size_t count = end - begin;
    for (std::size_t i = 0; i < count; ++i) {
      if (i % often == often - 1) {
        const M matters = hn::AndNot(test.is_past(d, cell, count, i, values), lit);
        if (hn::AllFalse(d, hn::AndNot(dark, hn::And(lanes, matters)))) break;
      }
      const auto all = [&](std::size_t column)
                           HWY_ATTR { return hn::Set(d, cell[column * count + i]); };
      dark = hn::Or(dark, hn::And(lanes, test(d, all, values)));
    }
  };
  const auto test_alone = [&](std::size_t begin, std::size_t end, std::size_t lane) HWY_ATTR {
    const T* const cell = grid.casters.cell(begin);
    const std::size_t count = end - begin;
    V own_values[size];
    for (std::size_t i = 0; i < size; ++i) own_values[i] = hn::Set(d, stored[i][lane]);
    for (std::size_t i = 0; i < count; i += most_lanes) {
      if (hn::AllTrue(d, test.is_past(d, cell, count, i, own_values))) break;
      const auto next = [&](std::size_t column)
                            HWY_ATTR { return hn::LoadU(d, cell + column * count + i); };
      const M hides = hn::And(test(d, next, own_values), hn::FirstN(d, count - i));
      if (!hn::AllFalse(d, hides)) {
        dark_alone |= std::uint64_t{1} << lane;
        break;
      }
    }
  };
  for_each_cell(d, grid.begins, cell_of_lane, lit, test_together, test_alone);
  return hn::And(lit, hn::Or(dark, mask_of(d, dark_alone)));
}

/// Where lanes look for what may hide them: in which cells, and in which of their parts, as
/// part_at() numbers them.
template <class V>
struct ListPlaces {
  V cell;
  V part;
};

/// Lanes of `lit` that something that their cell lists hides from the light: hides(primitive,
/// lanes, hidden) says whether it hides any of lanes, and which. `w` is how near to the light their
/// points are, as the entries' tops count it.
template <class D, class Hides, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_NOINLINE M occluded_in_lists(D d, const CellLists<T>& lists, const ListPlaces<V>& places, V w,
                                 M lit, const Hides& hides) {
  HWY_ALIGN T cells[hn::MaxLanes(D())];
  HWY_ALIGN T parts[hn::MaxLanes(D())];
  hn::Store(places.cell, d, cells);
  hn::Store(places.part, d, parts);
  const V highest = hn::Set(d, std::numeric_limits<T>::max());
  M dark = hn::Lt(w, w);
  // Tries those from `entry` on that may touch one of the parts that lanes are in. Returns where to
  // go on: at `end` if no more of the cell matter.
  const auto look_through = [&](std::size_t entry, std::size_t end, T least_w, M& rest) HWY_ATTR {
    unsigned wanted = 0;
    for (std::uint64_t left = bits_of(d, rest); left != 0; left &= left - 1)
      wanted |= 1U << static_cast<unsigned>(parts[hwy::Num0BitsBelowLS1Bit_Nonzero64(left)]);
    const std::size_t count = std::min(end - entry, entries_at_once);
    for (std::uint64_t here =
             entries_that_touch(lists.parts.data() + entry, count, static_cast<Parts>(wanted));
         here != 0; here &= here - 1) {
      const ListedCaster<T>& caster =
          lists.entries[entry + hwy::Num0BitsBelowLS1Bit_Nonzero64(here)];
      // This one and all behind it are farther from the light.
      if (caster.top <= least_w) return end;
      M hidden = rest;
      if (!hides(caster.primitive, rest, hidden)) continue;
      dark = hn::Or(dark, hidden);
      rest = hn::AndNot(hidden, rest);
      if (hn::AllFalse(d, rest)) return end;
    }
    return entry + count;
  };
  while (!hn::AllFalse(d, lit)) {
    // All lanes in the first one's cell.
    const T cell = cells[hn::FindFirstTrue(d, lit)];
    M rest = hn::And(lit, hn::Eq(places.cell, hn::Set(d, cell)));
    lit = hn::AndNot(rest, lit);
    const auto index = static_cast<std::size_t>(cell);
    std::size_t entry = lists.begins[index];
    const std::size_t end = lists.begins[index + 1];
    if (entry == end) continue;
    const T least_w = hn::GetLane(hn::MinOfLanes(d, hn::IfThenElse(rest, w, highest)));
    while (entry != end && lists.entries[entry].top > least_w)
      entry = look_through(entry, end, least_w, rest);
  }
  return dark;
}

/// Lanes of `lit` from which something that is set aside hides the light; `hides` is as above.
template <class D, class Hides, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_by_wide(D d, const CellLists<T>& lists, M lit, const Hides& hides) {
  M dark = hn::AndNot(lit, lit);
  const ListedCaster<T>* const begin = lists.entries.data() + lists.wide.begin;
  for (std::size_t i = 0; i < lists.wide.count && !hn::AllFalse(d, lit); ++i) {
    M hidden = lit;
    if (!hides(begin[i].primitive, lit, hidden)) continue;
    dark = hn::Or(dark, hidden);
    lit = hn::AndNot(hidden, lit);
  }
  return dark;
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
