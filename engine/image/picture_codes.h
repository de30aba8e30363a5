// Huffman codes for small pictures, made once instead of for each: to find the codes that fit a
// picture of 64 x 48 takes ISA-L three times as long as to write the picture in them.
//
// They fit how often differences to the row above, and matches of every length and distance, occur
// in the shipped scenes at 32 x 32 to 96 x 72. Of those pictures' own codes, which the mean file
// goes 6 % below, theirs are the mean.
#pragma once

#include <isa-l/igzip_lib.h>

#include <cstddef>

namespace raytracer {

/// Bytes up to which the file is not much larger for it: of 45 pictures 6 % on average, 37 % at
/// most, which were 85 bytes.
inline constexpr std::size_t largest_with_picture_codes = std::size_t{1} << 15;

const isal_hufftables& picture_codes();

}  // namespace raytracer
