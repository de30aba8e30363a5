// Pictures as tests compare them: 8-bit pixels out of a PNG, P6 or PF, decoded by other code than
// that which encoded them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace raytracer::test {

/// Rows of red, green and blue bytes, row 0 on top.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  bool operator==(const Picture&) const = default;
};

/// The same with a fourth byte, how much of the pixel is covered.
struct CoveredPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;
};

/// Each throws std::runtime_error that says what is wrong with the bytes.
CoveredPicture decode_covered_png(std::string_view bytes);
Picture decode_png(std::string_view bytes);
Picture decode_ppm(std::string_view bytes);
/// Rounded: floor(255 c + 1/2).
Picture decode_pfm(std::string_view bytes);

/// How far two pictures of one size are apart.
struct Difference {
  int most_levels = 0;      ///< the largest difference of a channel, of 255
  int different_count = 0;  ///< pixels with any difference
};

/// Throws std::runtime_error if their sizes differ.
Difference compare(const Picture& a, const Picture& b);

}  // namespace raytracer::test
