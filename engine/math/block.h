// How an image's pixels are grouped: blocks are traced and culled together, parts of them looked at
// together.
#pragma once

#include <cstddef>

namespace raytracer {

inline constexpr int block_side = 16;                        ///< in pixels
inline constexpr int part_side = 4;                          ///< in pixels
inline constexpr int parts_across = block_side / part_side;  ///< in a block
inline constexpr std::size_t parts_in_block = std::size_t{parts_across} * parts_across;

}  // namespace raytracer
