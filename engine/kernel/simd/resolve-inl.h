// What becomes of the sum of a pixel's samples: its colour, and what they tell of its error.

#include <cstddef>

#include "engine/errors/error_model.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// 1 / count.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE hn::Vec<D> share_of(D d, std::size_t count) {
  return hn::Set(d, static_cast<T>(1 / static_cast<double>(count)));
}

/// A pixel's colour of the sum of its clamped samples.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V3<V> resolved(D d, const V3<V>& sum, V share, Transfer transfer) {
  const V3<V> mean = clamped(d, scale(sum, share));  // of singles it may exceed 1 by a rounding
  return {encoded(d, transfer, mean.x), encoded(d, transfer, mean.y), encoded(d, transfer, mean.z)};
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE V3<V> max_zero(D d, const V3<V>& a) {
  const V zero = hn::Zero(d);
  return {hn::Max(a.x, zero), hn::Max(a.y, zero), hn::Max(a.z, zero)};
}

/// PixelSpread of the lanes' pixels.
template <class V>
struct Spread {
  V error2;
  V variance;
};

/// What the sums of a pixel's samples tell: of half buffer A, of all, and of the squares of their
/// differences from `origin`, one of them: squares of what is large leave nothing of what is small.
/// The halves are compared after the transfer.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE Spread<V> spread_of(D d, const V3<V>& sum_a, const V3<V>& all, const V3<V>& origin,
                               V squares, std::size_t count, Transfer transfer) {
  const V half = share_of(d, count / 2);
  const V whole = share_of(d, count);
  const V zero = hn::Zero(d);
  const auto shown = [&](const V3<V>& sum, V share)
                         HWY_ATTR { return resolved(d, max_zero(d, sum), share, transfer); };
  const V3<V> difference = sub(shown(sum_a, half), shown(sub(all, sum_a), half));
  const V error2 =
      hn::Mul(dot(difference, difference), hn::Set(d, T(SampleErrorModel::half_difference_share)));
  const V3<V> mean = scale(all, whole);
  const V3<V> shift = sub(mean, origin);
  const V variance = hn::Max(hn::MulSub(squares, whole, dot(shift, shift)), error2);
  // Not hn::Max: what is no number comes to nothing, too.
  return {hn::IfThenElseZero(hn::Gt(error2, zero), error2),
          hn::IfThenElseZero(hn::Gt(variance, zero), variance)};
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
