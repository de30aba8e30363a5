// How far two images are apart.
#pragma once

#include <cmath>
#include <cstddef>

#include "engine/image/image.h"

namespace raytracer::test {

/// The root mean square over the values of two images of a size.
inline double rms_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double difference = static_cast<double>(a.values[i]) - static_cast<double>(b.values[i]);
    sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<double>(a.values.size()));
}

}  // namespace raytracer::test
