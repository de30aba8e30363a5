#include "engine/image/picture_codes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <stdexcept>

namespace raytracer {
namespace {

// Occurrences in 100,000 symbols of a picture.
constexpr std::array<std::uint64_t, 9> differences{4479, 3081, 2537, 1645, 969, 512, 181, 56, 81};
constexpr std::uint64_t ends = 20;
constexpr std::array<std::uint64_t, 29> lengths{1,   4263, 2097, 1727, 552, 628, 574, 258, 448, 261,
                                                269, 172,  268,  156,  184, 213, 936, 180, 134, 104,
                                                346, 158,  221,  124,  214, 79,  15,  613, 1};
constexpr std::array<std::uint64_t, 30> distances{
    607,  65,   723, 51,  298, 98,  323, 184, 293, 180, 288, 303, 467, 862, 607,
    1217, 1138, 349, 490, 271, 331, 205, 228, 141, 178, 55,  45,  4,   1,   1};

isal_hufftables make_codes() {
  constexpr std::size_t bytes = 256;
  isal_huff_histogram histogram{};
  for (unsigned int byte = 0; byte < bytes; ++byte) {
    const unsigned int difference = std::min<unsigned int>(byte, bytes - byte);
    histogram.lit_len_histogram[byte] = differences[std::bit_width(difference)];
  }
  histogram.lit_len_histogram[bytes] = ends;
  std::copy(lengths.begin(), lengths.end(), histogram.lit_len_histogram + bytes + 1);
  std::copy(distances.begin(), distances.end(), histogram.dist_histogram);
  isal_hufftables codes{};
  if (isal_create_hufftables(&codes, &histogram) != 0)
    throw std::logic_error("ISA-L finds no codes for pictures");
  return codes;
}

}  // namespace

const isal_hufftables& picture_codes() {
  static const isal_hufftables codes = make_codes();
  return codes;
}

}  // namespace raytracer
