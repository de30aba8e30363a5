// Places in a pixel.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace raytracer {

/// 0 to 1 to the right and upwards.
struct SamplePoint {
  double x;
  double y;
};

/// The places of a pixel's samples, and how those of its neighbours differ from them: in pixel
/// (x, y) the places are moved away from the pixel's middle lines by `jitter` times
/// jitter_of(x, y), so that their own middle stays. With none, an edge along a row of pixels
/// passes all of them alike, and is seen by all or by none.
struct SamplePattern {
  std::vector<SamplePoint> points;
  /// If the points are in two half buffers, A and B, that are spread alike: those of A come first.
  std::size_t half_a_count = 0;
  double jitter = 0;

  bool has_half_buffers() const { return half_a_count > 0; }
};

/// `distance` to the side of the pixel's middle on which the coordinate lies.
constexpr double away_from_middle(double coordinate, double distance) {
  return coordinate < 0.5 ? -distance : distance;
}

/// For pixels of a square of 4 x 4: from -1/2 to 1/2, as evenly as possible along its rows (x) and
/// columns (y), each value once.
constexpr SamplePoint jitter_of(int x, int y) {
  constexpr std::array<int, 4> order{0, 2, 3, 1};
  const auto i = static_cast<std::size_t>(x % 4);
  const auto j = static_cast<std::size_t>(y % 4);
  return {(4 * order[j] + order[i] + 0.5) / 16 - 0.5, (4 * order[i] + order[j] + 0.5) / 16 - 0.5};
}

}  // namespace raytracer
