// Arithmetic in about twice the precision of a double.
#pragma once

#include <cmath>

#include "engine/math/vec.h"

namespace raytracer {

/// A sum whose roundings are summed, too (Ogita, Rump, Oishi: "Accurate Sum and Dot Product", SIAM
/// J. Sci. Comput. 2005, Dot2).
struct CompensatedSum {
  double value = 0;
  double rest = 0;

  void add(double term) {
    const double sum = value + term;
    const double rounded = sum - value;
    rest += (value - (sum - rounded)) + (term - rounded);
    value = sum;
  }
  void add_product(double a, double b) {
    const double product = a * b;
    rest += std::fma(a, b, -product);
    add(product);
  }
  double total() const { return value + rest; }
};

/// A vector of doubles and what they leave.
struct Split {
  Vec3 high;
  Vec3 low;
};

/// a - b exactly (Knuth: TwoSum).
inline Split exact_difference(const Vec3& a, const Vec3& b) {
  const Vec3 high = a - b;
  const auto low = [](double x, double y, double difference) {
    const double minus_y = difference - x;
    return (x - (difference - minus_y)) - (y + minus_y);
  };
  return {high, {low(a.x, b.x, high.x), low(a.y, b.y, high.y), low(a.z, b.z, high.z)}};
}

inline Split scaled(const Split& a, int exponent) {
  return {scaled(a.high, exponent), scaled(a.low, exponent)};
}

}  // namespace raytracer
