// A packet of rays: one to a lane. Compiled once for each instruction set.

#include <hwy/highway.h>

#include <cstdint>
#include <cstring>

#include "engine/math/triple.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Of a lambda that is to become part of the function around it: what a function out of line is told
// of stays in memory.
#ifndef RAYTRACER_INLINE_ATTR
#define RAYTRACER_INLINE_ATTR HWY_ATTR __attribute__((always_inline))
#endif

/// Three lanes' worth of coordinates.
template <class V>
struct V3 {
  V x;
  V y;
  V z;
};

template <class D, typename T = hn::TFromD<D>>
HWY_INLINE V3<hn::Vec<D>> broadcast(D d, const Triple<T>& a) {
  return {hn::Set(d, a.x), hn::Set(d, a.y), hn::Set(d, a.z)};
}

template <class D, typename T = hn::TFromD<D>>
HWY_INLINE V3<hn::Vec<D>> load(D d, const T* x, const T* y, const T* z) {
  return {hn::Load(d, x), hn::Load(d, y), hn::Load(d, z)};
}

template <class V>
HWY_INLINE V dot(const V3<V>& a, const V3<V>& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

template <class V>
HWY_INLINE V3<V> sub(const V3<V>& a, const V3<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

template <class V>
HWY_INLINE V3<V> add(const V3<V>& a, const V3<V>& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}

/// a * s + b.
template <class V>
HWY_INLINE V3<V> mul_add(const V3<V>& a, V s, const V3<V>& b) {
  return {hn::MulAdd(a.x, s, b.x), hn::MulAdd(a.y, s, b.y), hn::MulAdd(a.z, s, b.z)};
}

template <class V>
HWY_INLINE V3<V> scale(const V3<V>& a, V s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}

template <class V>
HWY_INLINE V3<V> negate(const V3<V>& a) {
  return {hn::Neg(a.x), hn::Neg(a.y), hn::Neg(a.z)};
}

template <class M, class V>
HWY_INLINE V3<V> select(M mask, const V3<V>& yes, const V3<V>& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}

/// 1 / sqrt(a). In single precision on x86 by the processor's estimate of 12 bits or more and one
/// step of Newton's method: within an ulp or two, in a fraction of the time.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V inverse_root(D d, V a) {
  using T = hn::TFromD<D>;
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR
  if constexpr (sizeof(T) == sizeof(float)) {
    const V estimate = hn::ApproximateReciprocalSqrt(a);
    const V error = hn::NegMulAdd(hn::Mul(a, estimate), estimate, hn::Set(d, T(1)));
    return hn::MulAdd(hn::Mul(hn::Set(d, T(0.5)), estimate), error, estimate);
  }
#endif
  return hn::Div(hn::Set(d, T(1)), hn::Sqrt(a));
}

/// 1 / a, likewise.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V inverse(D d, V a) {
  using T = hn::TFromD<D>;
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR
  if constexpr (sizeof(T) == sizeof(float)) {
    const V estimate = hn::ApproximateReciprocal(a);
    const V error = hn::NegMulAdd(a, estimate, hn::Set(d, T(1)));
    return hn::MulAdd(estimate, error, estimate);
  }
#endif
  return hn::Div(hn::Set(d, T(1)), a);
}

/// A bit for each lane, the first lane's lowest.
template <class D, class M = hn::Mask<D>>
HWY_INLINE std::uint64_t bits_of(D d, M mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  if constexpr (hn::MaxLanes(D()) <= 8) return bytes[0];
  // No more than was stored: a processor waits long for what it stored in pieces.
  std::uint16_t bits = 0;
  static_assert(hn::MaxLanes(D()) <= 8 * sizeof(bits));
  std::memcpy(&bits, bytes, sizeof(bits));
  return bits;
}

/// The lanes whose bits are set.
template <class D>
HWY_INLINE hn::Mask<D> mask_of(D d, std::uint64_t bits) {
  std::uint8_t bytes[8];
  std::memcpy(bytes, &bits, sizeof(bits));
  return hn::LoadMaskBits(d, bytes);
}

/// hn::CountTrue, which g++ 12 reads from 64 bits where it has put a mask's 16 on the stack.
template <class D, class M = hn::Mask<D>>
HWY_INLINE std::size_t count_true(D d, M mask) {
  return hwy::PopCount(bits_of(d, mask));
}

/// The lanes' directions; the zero vector gives no number.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V3<V> unit(D d, const V3<V>& a) {
  return scale(a, inverse_root(d, dot(a, a)));
}

/// A zero slope made a tiny one of its sign: no product with its inverse is then other than a
/// number.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V without_zero(D d, V slope) {
  const V tiny = hn::Set(d, hn::TFromD<D>(1e-30));
  return hn::IfThenElse(hn::Lt(hn::Abs(slope), tiny), hn::CopySign(tiny, slope), slope);
}

/// The lanes' planes across their rays (see orthonormal_basis() in engine/math/vec.h).
template <class V>
struct BasisPacket {
  V3<V> u;
  V3<V> v;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE BasisPacket<V> basis_across(D d, const V3<V>& w) {
  const V one = hn::Set(d, hn::TFromD<D>(1));
  const V sign = hn::CopySign(one, w.z);
  const V a = hn::Neg(hn::Div(one, hn::Add(sign, w.z)));
  const V b = hn::Mul(hn::Mul(w.x, w.y), a);
  return {{hn::MulAdd(hn::Mul(sign, w.x), hn::Mul(w.x, a), one), hn::Mul(sign, b),
           hn::Neg(hn::Mul(sign, w.x))},
          {b, hn::MulAdd(hn::Mul(w.y, w.y), a, sign), hn::Neg(w.y)}};
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
