// The lines across a pixel along which its colour is integrated.
#pragma once

#include <cstddef>

namespace raytracer {

/// So many lines from one side of a pixel to the other, a multiple of three, at (k + 1/2) / count
/// of the pixel's height. Or of its width: they go to the right or upwards, whichever crosses what
/// the pixel shows rather than follows it.
///
/// The middle ones of each three are again such lines, and tell the error of all.
struct LinePattern {
  std::size_t count = 3;
};

/// More than any pixel is given.
inline constexpr std::size_t most_lines_of_pixel = 1024;

}  // namespace raytracer
