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

}  // namespace raytracer
