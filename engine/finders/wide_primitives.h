// Which of many primitives are so wide that a grid would suit none of the others: the ground under
// a thousand pebbles.
//
// Cells are as wide as suits what is entered into them, and all of it. A few that are far wider
// than the rest are set aside, to be tried for every point, if cells may then be so much narrower
// that it pays.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/math/triple.h"

namespace raytracer {

/// The entries of a grid's last bin, which is no cell: of those that are tried for every point.
struct WideEntries {
  std::size_t begin = 0;
  std::size_t count = 0;
};

/// Those behind the entries of a grid's `cell_count` cells; `begins` of these and of all bins.
inline WideEntries entries_behind(const std::vector<std::uint32_t>& begins,
                                  std::size_t cell_count) {
  return {begins[cell_count], begins.back() - begins[cell_count]};
}

/// What primitives cover in sum, apart by how wide they are: from one power of two to the next. A
/// Spread counts its primitives in `primitive_count` and adds another one by include().
template <typename Spread>
struct SpreadsByWidth {
  static constexpr std::size_t width_count = 32;
  std::array<Spread, width_count> spreads{};

  /// In which one something is. Frames are about 1 in size.
  static std::size_t index_of(double width) {
    constexpr int least = -28;
    constexpr int most = least + static_cast<int>(width_count) - 1;
    if (!(width > 0)) return 0;
    return static_cast<std::size_t>(std::clamp(std::ilogb(width), least, most) - least);
  }
  void include(const SpreadsByWidth& other) {
    for (std::size_t i = 0; i < width_count; ++i) spreads[i].include(other.spreads[i]);
  }
};

/// Which primitives are set aside, and what the others cover.
template <typename Spread>
struct SpreadWithoutWide {
  Spread spread;
  std::size_t wide_from = SpreadsByWidth<Spread>::width_count;  ///< as index_of() has it

  bool is_wide(double width) const {
    return has_wide() && SpreadsByWidth<Spread>::index_of(width) >= wide_from;
  }
  bool has_wide() const { return wide_from < SpreadsByWidth<Spread>::width_count; }
};

/// Sets those aside with which the fewest are tried for a point. cell_width(spread) says how wide
/// cells suit what is spread so.
template <typename Spread, typename CellWidth>
SpreadWithoutWide<Spread> without_wide(const SpreadsByWidth<Spread>& by_width,
                                       const CellWidth& cell_width) {
  // Chosen: as many as are tried in cells of the width that suits.
  constexpr double tried_in_cell = 4;
  // Chosen: as many as a packet tries while it goes through a few cells.
  constexpr std::size_t most_wide = 32;
  std::size_t all = 0;
  for (const Spread& spread : by_width.spreads) all += spread.primitive_count;
  SpreadWithoutWide<Spread> chosen;
  double fewest_tried = infinity;
  double least_width = 0;  // of cells: with as many set aside as may be
  Spread below;
  for (std::size_t i = 0; i < by_width.spreads.size(); ++i) {
    if (by_width.spreads[i].primitive_count == 0) continue;
    below.include(by_width.spreads[i]);
    const std::size_t wide = all - below.primitive_count;
    if (wide > most_wide || wide > below.primitive_count) continue;
    const double width = cell_width(below);
    if (least_width == 0) least_width = width;
    const double crowd = width / least_width;
    const double tried =
        static_cast<double>(wide) +
        std::min(static_cast<double>(below.primitive_count), tried_in_cell * crowd * crowd);
    if (tried >= fewest_tried) continue;
    fewest_tried = tried;
    chosen = {below, wide > 0 ? i + 1 : by_width.spreads.size()};
  }
  return chosen;
}

}  // namespace raytracer
