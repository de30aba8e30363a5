// Several PNGs of one size as one animated PNG (APNG, PNG Specification 3rd edition,
// section 11.3.6).
#pragma once

#include <string>
#include <vector>

namespace raytracer::client {

/// Frames a second, as a ratio.
struct FrameRate {
  int numerator = 25;
  int denominator = 1;
};

/// It runs for ever, at the rate or, where 16 bits do not hold that, at the nearest one. Throws
/// ServerError if the frames are no PNGs of the same size and kind.
std::string animated_png(const std::vector<std::string>& frames, FrameRate rate);

}  // namespace raytracer::client
