#include "tests/measure/bench/image_difference.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "engine/math/transfer.h"

namespace raytracer::bench {
namespace {

unsigned char stored(double channel, Transfer transfer) {
  return to_byte(static_cast<float>(encode_channel(channel, transfer)));
}

}  // namespace

ImageDifference compare_images(const ByteImage& a, const ByteImage& b) {
  if (a.width != b.width || a.height != b.height)
    throw std::runtime_error("two peers drew pictures of different sizes");
  constexpr int most_levels = 2;
  double squares = 0;
  std::size_t off = 0;
  for (std::size_t pixel = 0; pixel < a.values.size(); pixel += 3) {
    bool is_off = false;
    for (std::size_t i = pixel; i < pixel + 3; ++i) {
      const int levels = std::abs(int{a.values[i]} - int{b.values[i]});
      squares += levels * levels;
      is_off = is_off || levels > most_levels;
    }
    if (is_off) ++off;
  }
  const auto count = static_cast<double>(a.values.size());
  return {std::sqrt(squares / count) / 255, 3 * static_cast<double>(off) / count};
}

ByteImage rounded(const Image& image) {
  ByteImage bytes(image.width, image.height);
  std::transform(image.values.begin(), image.values.end(), bytes.values.begin(), to_byte);
  return bytes;
}

double covered_share(const ByteImage& image, const Rgb& background, Transfer transfer) {
  const unsigned char bytes[] = {stored(background.x, transfer), stored(background.y, transfer),
                                 stored(background.z, transfer)};
  std::size_t covered = 0;
  for (std::size_t i = 0; i < image.values.size(); i += 3)
    if (!std::equal(bytes, bytes + 3, image.values.begin() + static_cast<std::ptrdiff_t>(i)))
      ++covered;
  return 3 * static_cast<double>(covered) / static_cast<double>(image.values.size());
}

}  // namespace raytracer::bench
