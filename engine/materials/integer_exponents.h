// Exponents of highlights that are small integers: their powers are products.
#pragma once

#include <cstdint>
#include <vector>

namespace raytracer {

/// By their bits, of which a packet multiplies for those that any of them has.
struct IntegerExponents {
  bool are_all = false;   ///< there are exponents, and each is an integer of at most 4096
  std::uint32_t any = 0;  ///< the bits that some of them have
  std::uint32_t all = 0;  ///< the bits that all of them have

  friend bool operator==(const IntegerExponents&, const IntegerExponents&) = default;
};

/// Nothing if one of them is no such integer.
IntegerExponents find_integer_exponents(const std::vector<double>& exponents);

}  // namespace raytracer
