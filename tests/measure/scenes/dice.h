// Chance for scenes that are made, not written: the same numbers on every machine and run.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "engine/math/vec.h"

namespace raytracer::measure {

/// Taken from the generator's bits: the standard's distributions differ between libraries.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : generator_(seed) {}

  double within(double least, double most) {
    return least + (most - least) * (static_cast<double>(generator_() >> 11) * 0x1p-53);
  }
  /// As often from 1 to 10 as from 10 to 100.
  double of_any_size(double least, double most) {
    return least * std::pow(most / least, within(0, 1));
  }
  /// Both included.
  int count(int least, int most) {
    return std::min(most, static_cast<int>(std::floor(within(least, most + 1.0))));
  }
  /// Both included, small ones as often as large ones.
  int count_of_any_size(int least, int most) {
    return std::min(most, static_cast<int>(std::floor(of_any_size(least, most + 1.0))));
  }
  bool happens(double probability) { return within(0, 1) < probability; }
  /// In the cube from -half to half.
  Vec3 point(double half) {
    const double x = within(-half, half);
    const double y = within(-half, half);
    return {x, y, within(-half, half)};
  }
  /// Of length 1.
  Vec3 direction() {
    for (;;) {
      const Vec3 inside = point(1);
      if (length(inside) <= 1 && length(inside) > 0.1) return unit(inside);
    }
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace raytracer::measure
