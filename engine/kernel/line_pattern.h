// The lines across a pixel along which its colour is integrated.
#pragma once

#include <cstddef>

namespace raytracer {

/// So many lines from one side of a pixel to the other, a multiple of three, with as much between
/// them as twice to the sides beside them. They go to the right or upwards, whichever crosses what
/// the pixel shows rather than follows it.
///
/// The middle ones of each three are again such lines, and tell the error of all.
struct LinePattern {
  std::size_t count = 3;
};

}  // namespace raytracer
