#include "engine/sample/neighbour_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "engine/sample/error_rules.h"

namespace raytracer {
namespace {

constexpr double share = 1.0 / 8;

/// The sum of squared differences of `count` values, three for a pixel.
double squares_between(const float* a, const float* b, std::size_t count) {
  // The channels' sums do not wait for each other.
  std::array<double, 3> sums{};
  for (std::size_t i = 0; i < count; i += sums.size())
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const double difference = static_cast<double>(a[i + k]) - static_cast<double>(b[i + k]);
      sums[k] += difference * difference;
    }
  return sums[0] + sums[1] + sums[2];
}

double squares_between(const unsigned char* a, const unsigned char* b, std::size_t count) {
  constexpr std::size_t most_in_32_bits = 1 << 16;
  std::uint64_t sum = 0;
  for (std::size_t begin = 0; begin < count; begin += most_in_32_bits) {
    std::uint32_t piece = 0;
    for (std::size_t i = begin; i < std::min(begin + most_in_32_bits, count); ++i) {
      const int difference = a[i] - b[i];
      piece += static_cast<std::uint32_t>(difference * difference);
    }
    sum += piece;
  }
  return static_cast<double>(sum) / (255.0 * 255.0);
}

template <typename Channel>
double error2(const Raster<Channel>& image, const Tile& tile) {
  // Those to the right of the tile and below it count, too, where the image has them.
  const auto count = [](int pixels) { return 3 * static_cast<std::size_t>(std::max(pixels, 0)); };
  const int width = tile.x_end - tile.x_begin;
  const int right = std::min(tile.x_end, image.width - 1) - tile.x_begin;
  double sum = 0;
  for (int y = tile.y_begin; y < tile.y_end; ++y) {
    const Channel* const row = image.pixel(tile.x_begin, y);
    sum += squares_between(row, row + 3, count(right));
    if (y + 1 < image.height)
      sum += squares_between(row, image.pixel(tile.x_begin, y + 1), count(width));
  }
  return share * sum;
}

template <typename Channel>
double error_of(const Raster<Channel>& image, int samples) {
  // All rows would take as long as to trace a simple picture.
  constexpr int most_rows = 16;
  const int rows = std::min(image.height, most_rows);
  double sum = 0;
  for (int i = 0; i < rows; ++i) {
    const auto y = static_cast<int>(std::int64_t{i} * image.height / rows);
    sum += error2(image, {0, y, image.width, y + 1});
  }
  const double values = 3 * static_cast<double>(image.width) * rows;
  return std::sqrt(sum / values / error_power(samples));
}

}  // namespace

double neighbour_error2(const Image& image, const Tile& tile) { return error2(image, tile); }

double neighbour_error(const Image& image, int samples) { return error_of(image, samples); }
double neighbour_error(const ByteImage& image, int samples) { return error_of(image, samples); }

}  // namespace raytracer
