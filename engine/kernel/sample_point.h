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

/// The places of a pixel's samples. With a `jitter`, sample_in() says where they are in each pixel:
/// with none, an edge along a row of pixels passes all of them alike, and is seen by all or by
/// none.
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

/// For pixels of a square of 16 x 16, a block: from -1/2 to 1/2, each value once. Along rows in y
/// and along columns in x they are as even as possible, four neighbours that begin at a multiple of
/// four in each quarter once; along diagonals, x + y and x - y leave gaps of no more than a third.
/// An edge along any of these passes its pixels' places otherwise than alike. Both orders are
/// chosen among random ones, for the smallest gaps.
constexpr SamplePoint jitter_of(int x, int y) {
  constexpr int side = 16;
  constexpr std::array<int, side> of_row{9, 1, 13, 5, 12, 4, 2, 8, 10, 3, 6, 14, 15, 11, 7, 0};
  constexpr std::array<int, side> of_column{2, 14, 5, 8, 11, 4, 0, 12, 13, 1, 10, 6, 9, 15, 3, 7};
  const auto i = static_cast<std::size_t>(x % side);
  const auto j = static_cast<std::size_t>(y % side);
  constexpr double all = side * side;
  return {(side * of_column[j] + of_column[i] + 0.5) / all - 0.5,
          (side * of_row[i] + of_row[j] + 0.5) / all - 0.5};
}

/// How a pattern is turned in a pixel (x, y) with a jitter: of a square of 2 x 2 each otherwise, as
/// what lies in rows along one direction does not along another.
struct PatternTurn {
  bool is_transposed;  ///< columns are rows
  bool is_mirrored;    ///< then left is right

  constexpr PatternTurn(int x, int y) : is_transposed((x + y) % 2 != 0), is_mirrored(y % 2 != 0) {}
};

/// Where a sample's place is in pixel (x, y): turned, and moved away from the pixel's middle lines
/// by `jitter` times jitter_of(x, y). The middle of all places stays where it is.
constexpr SamplePoint sample_in(int x, int y, const SamplePoint& sample, double jitter) {
  if (!(jitter > 0)) return sample;
  const PatternTurn turn(x, y);
  SamplePoint turned = sample;
  if (turn.is_transposed) turned = {sample.y, sample.x};
  if (turn.is_mirrored) turned.x = 1 - turned.x;
  const SamplePoint moved = jitter_of(x, y);
  return {turned.x + away_from_middle(turned.x, jitter) * moved.x,
          turned.y + away_from_middle(turned.y, jitter) * moved.y};
}

}  // namespace raytracer
