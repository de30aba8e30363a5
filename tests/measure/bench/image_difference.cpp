#include "tests/measure/bench/image_difference.h"

#include <cstdlib>
#include <stdexcept>

namespace raytracer::bench {

ImageDifference compare_images(const ByteImage& a, const ByteImage& b) {
  if (a.width != b.width || a.height != b.height)
    throw std::runtime_error("two peers drew pictures of different sizes");
  constexpr int most_levels = 2;
  double sum = 0;
  std::size_t off = 0;
  for (std::size_t pixel = 0; pixel < a.values.size(); pixel += 3) {
    bool is_off = false;
    for (std::size_t i = pixel; i < pixel + 3; ++i) {
      const int levels = std::abs(int{a.values[i]} - int{b.values[i]});
      sum += levels;
      is_off = is_off || levels > most_levels;
    }
    if (is_off) ++off;
  }
  const auto count = static_cast<double>(a.values.size());
  return {3 * static_cast<double>(off) / count, sum / count};
}

double covered_share(const ByteImage& image, const Rgb& background) {
  const auto byte = [](double channel) { return to_byte(static_cast<float>(channel)); };
  std::size_t covered = 0;
  for (std::size_t i = 0; i < image.values.size(); i += 3)
    if (image.values[i] != byte(background.x) || image.values[i + 1] != byte(background.y) ||
        image.values[i + 2] != byte(background.z))
      ++covered;
  return 3 * static_cast<double>(covered) / static_cast<double>(image.values.size());
}

}  // namespace raytracer::bench
