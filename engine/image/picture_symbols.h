// How often a small picture's symbols occur, for Huffman codes that are made once instead of for
// each: to find the codes that fit a picture of 64 x 48 takes ISA-L three times as long as to write
// the picture in them.
//
// The means of the shipped scenes at 32 x 32, 64 x 48 and 96 x 72, each picture counting alike,
// after the PNG filter "up": differences to the row above, and DEFLATE's lengths and distances.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace raytracer::picture_symbols {

/// Bytes up to which a file is not much larger for it: of 49 pictures by 6 % on average, by 37 % at
/// most, which were 85 bytes.
inline constexpr std::size_t largest_picture = std::size_t{1} << 15;

/// Of each byte, in 100,000: 0, 1, 2 to 3, 4 to 7, ... 128, whatever the sign.
inline constexpr std::array<std::uint64_t, 9> differences{4479, 3081, 2537, 1645, 969,
                                                          512,  181,  56,   81};
inline constexpr std::uint64_t ends = 20;
inline constexpr std::array<std::uint64_t, 29> lengths{
    1,   4263, 2097, 1727, 552, 628, 574, 258, 448, 261, 269, 172, 268, 156, 184,
    213, 936,  180,  134,  104, 346, 158, 221, 124, 214, 79,  15,  613, 1};
inline constexpr std::array<std::uint64_t, 30> distances{
    607,  65,   723, 51,  298, 98,  323, 184, 293, 180, 288, 303, 467, 862, 607,
    1217, 1138, 349, 490, 271, 331, 205, 228, 141, 178, 55,  45,  4,   1,   1};

}  // namespace raytracer::picture_symbols
