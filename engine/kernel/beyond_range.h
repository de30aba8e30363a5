// Pixels whose colour is not one that can be shown.
#pragma once

#include <cstddef>

namespace raytracer {

/// Of a tile or an image; no pixel is counted twice.
struct BeyondRange {
  std::size_t clamped = 0;      ///< pixels with a sample brighter than 1 in some channel
  std::size_t not_numbers = 0;  ///< pixels with a sample of no number: a fault, never expected

  BeyondRange& operator+=(const BeyondRange& other) {
    clamped += other.clamped;
    not_numbers += other.not_numbers;
    return *this;
  }
};

}  // namespace raytracer
