// From linear light to what is stored, of all lanes.

#include "engine/math/transfer.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// x^(5/12) as sqrt(x) * t^(-1/3), t the fourth root of x: within a few roundings for x from sRGB's
/// `straight_end` to 1; elsewhere it means nothing.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V five_twelfths_power(D d, V x) {
  // The cubic, near t^(-1/3) at Chebyshev's nodes, is off by 0.6 % at most. A Newton step, which
  // needs no division, leaves twice the square of that: 7e-5, 1e-8, 2e-16.
  constexpr int steps = sizeof(T) == sizeof(float) ? 2 : 3;
  const V root = hn::Sqrt(x);
  const V t = hn::Sqrt(root);
  const V linear = hn::MulAdd(t, hn::Set(d, T(-3.111)), hn::Set(d, T(2.185)));
  const V square = hn::MulAdd(t, hn::Set(d, T(-1.184)), hn::Set(d, T(3.1073)));
  V inverse = hn::MulAdd(hn::Mul(t, t), square, linear);
  const V one = hn::Set(d, T(1));
  const V third = hn::Set(d, T(1.0 / 3));
  for (int step = 0; step < steps; ++step) {
    const V residual = hn::NegMulAdd(hn::Mul(t, inverse), hn::Mul(inverse, inverse), one);
    inverse = hn::MulAdd(hn::Mul(inverse, third), residual, inverse);
  }
  return hn::Mul(root, inverse);
}

/// As encode_channel() in engine/math/transfer.h, for at most 1.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V encoded(D d, Transfer transfer, V linear) {
  if (transfer == Transfer::linear) return linear;
  using Curve = SrgbCurve;
  static_assert(Curve::exponent == 12.0 / 5);
  const auto is_dark = hn::Le(linear, hn::Set(d, T(Curve::straight_end)));
  const V straight = hn::Mul(hn::Set(d, T(Curve::slope)), linear);
  if (hn::AllTrue(d, is_dark)) return straight;
  const V power = five_twelfths_power(d, linear);
  const V curved = hn::MulSub(hn::Set(d, T(Curve::scale)), power, hn::Set(d, T(Curve::offset)));
  return hn::IfThenElse(is_dark, straight, hn::Min(curved, hn::Set(d, T(1))));
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
