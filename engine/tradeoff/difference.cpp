#include "engine/tradeoff/difference.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace raytracer {

Difference difference(const Image& image, const Image& reference) {
  constexpr double visible = 1.0 / 255;
  Difference result;
  double squares = 0;
  std::size_t off_count = 0;
  const std::size_t channels = image.length_of(1);
  for (std::size_t pixel = 0; pixel < image.values.size(); pixel += channels) {
    double largest = 0;
    for (std::size_t i = pixel; i < pixel + channels; ++i) {
      const double apart =
          std::abs(static_cast<double>(image.values[i]) - static_cast<double>(reference.values[i]));
      squares += apart * apart;
      largest = std::max(largest, apart);
    }
    result.max_error = std::max(result.max_error, largest);
    if (largest > visible) ++off_count;
  }
  const auto value_count = static_cast<double>(image.values.size());
  result.rmse = std::sqrt(squares / value_count);
  result.off_share = static_cast<double>(channels * off_count) / value_count;
  return result;
}

}  // namespace raytracer
