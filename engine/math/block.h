// How an image's pixels are grouped: blocks are traced and culled together, subtiles of them looked
// at together.
#pragma once

#include <cstddef>

namespace raytracer {

inline constexpr int block_side = 16;                              ///< in pixels
inline constexpr int subtile_side = 4;                             ///< in pixels
inline constexpr int subtiles_across = block_side / subtile_side;  ///< in a block
inline constexpr std::size_t subtiles_in_block = std::size_t{subtiles_across} * subtiles_across;

/// That so many pixels in a row or a column take.
constexpr std::size_t blocks_along(int pixels) {
  return static_cast<std::size_t>((pixels + block_side - 1) / block_side);
}

/// The block that an image's pixel (x, y) is in: they are numbered row by row, `columns` in each.
constexpr std::size_t block_index(int x, int y, std::size_t columns) {
  return static_cast<std::size_t>(y / block_side) * columns +
         static_cast<std::size_t>(x / block_side);
}

/// The subtile of a block that its pixel (x, y) is in: they are numbered row by row.
constexpr int subtile_index(int x, int y) {
  return y / subtile_side * subtiles_across + x / subtile_side;
}

}  // namespace raytracer
