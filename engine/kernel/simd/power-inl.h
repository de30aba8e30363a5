// Powers with integer exponents.

#if defined(RAYTRACER_KERNEL_SIMD_POWER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_POWER_INL_H_
#undef RAYTRACER_KERNEL_SIMD_POWER_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_POWER_INL_H_
#endif

#include "engine/kernel/simd/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// x^exponent for x in [0, 1], by squaring from the exponent's highest bit; 0^0 = 1.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V integer_power(D d, V x, std::int32_t exponent) {
  if (exponent == 0) return hn::Set(d, hn::TFromD<D>(1));
  const auto bits = static_cast<std::uint32_t>(exponent);
  V power = x;
  std::uint32_t bit = std::uint32_t{1} << (31 - hwy::Num0BitsAboveMS1Bit_Nonzero32(bits));
  while ((bit >>= 1U) != 0) {
    power = hn::Mul(power, power);
    if ((bits & bit) != 0) power = hn::Mul(power, x);
  }
  return power;
}

/// sqrt(square)^exponent, likewise; most exponents need no root.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V power_of_root(D d, V square, std::int32_t exponent) {
  const V power = integer_power(d, square, exponent / 2);
  return exponent % 2 == 0 ? power : hn::Mul(power, hn::Sqrt(square));
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
