#include "engine/materials/integer_exponents.h"

#include <algorithm>
#include <cmath>

namespace raytracer {

IntegerExponents find_integer_exponents(const std::vector<double>& exponents) {
  constexpr double most = 4096;
  const bool are_all = std::all_of(exponents.begin(), exponents.end(), [](double exponent) {
    return exponent == std::floor(exponent) && exponent <= most;
  });
  if (exponents.empty() || !are_all) return {};
  IntegerExponents found{true, 0, ~std::uint32_t{0}};
  for (const double exponent : exponents) {
    const auto bits = static_cast<std::uint32_t>(exponent);
    found.any |= bits;
    found.all &= bits;
  }
  return found;
}

}  // namespace raytracer
