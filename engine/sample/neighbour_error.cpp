#include "engine/sample/neighbour_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <type_traits>

#include "engine/errors/error_model.h"

namespace raytracer {
namespace {

/// The sum of squared differences of `count` values, so many for a pixel, of which 1 is the
/// largest.
template <std::size_t channels, typename Channel>
double squares_between(const Channel* a, const Channel* b, std::size_t count) {
  constexpr double largest = std::is_integral_v<Channel> ? 255 : 1;
  // The channels' sums do not wait for each other.
  std::array<double, channels> sums{};
  for (std::size_t i = 0; i < count; i += sums.size())
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const double difference = static_cast<double>(a[i + k]) - static_cast<double>(b[i + k]);
      sums[k] += difference * difference;
    }
  return std::accumulate(sums.begin(), sums.end(), 0.0) / (largest * largest);
}

template <std::size_t channels, typename Channel>
double error2_of(const Raster<Channel>& image, const Tile& tile) {
  // Those to the right of the tile and below it count, too, where the image has them.
  const auto count = [&](int pixels) { return image.length_of(std::max(pixels, 0)); };
  const int right = std::min(tile.x_end, image.width - 1) - tile.x_begin;
  double sum = 0;
  for (int y = tile.y_begin; y < tile.y_end; ++y) {
    const Channel* const row = image.pixel(tile.x_begin, y);
    sum += squares_between<channels>(row, row + channels, count(right));
    if (y + 1 < image.height)
      sum += squares_between<channels>(row, image.pixel(tile.x_begin, y + 1), count(tile.width()));
  }
  return SampleErrorModel::edge_share * sum;
}

template <typename Channel>
double error2(const Raster<Channel>& image, const Tile& tile) {
  return image.channels == 4 ? error2_of<4>(image, tile) : error2_of<3>(image, tile);
}

template <typename Channel>
double error_of(const Raster<Channel>& image, int samples) {
  const int rows = std::min(image.height, SampleErrorModel::edge_rows);
  double sum = 0;
  for (int i = 0; i < rows; ++i) {
    const auto y = static_cast<int>(std::int64_t{i} * image.height / rows);
    sum += error2(image, {0, y, image.width, y + 1});
  }
  const double values = static_cast<double>(image.length_of(image.width)) * rows;
  return std::sqrt(sum / values / error_power(samples));
}

}  // namespace

double neighbour_error2(const Image& image, const Tile& tile) { return error2(image, tile); }

double neighbour_error(const Image& image, int samples) { return error_of(image, samples); }
double neighbour_error(const ByteImage& image, int samples) { return error_of(image, samples); }

}  // namespace raytracer
