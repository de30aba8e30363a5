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

/// A pixel's values in an image that has a cover.
template <class V>
struct CoveredColour {
  V3<V> colour;  ///< times the cover
  V cover;
};

/// Of the sums of a pixel's clamped samples and of its hits: the colours of what was met take part
/// in the transfer, not those that it has over black.
template <class D, class V = hn::Vec<D>>
HWY_INLINE CoveredColour<V> resolved(D d, const CoveredColour<V>& sum, V share, Transfer transfer) {
  const V one = hn::Set(d, hn::TFromD<D>(1));
  const V cover = hn::Min(hn::Mul(sum.cover, share), one);
  if (transfer == Transfer::linear) return {resolved(d, sum.colour, share, transfer), cover};
  const V hits = hn::Max(sum.cover, one);
  return {scale(resolved(d, sum.colour, hn::Div(one, hits), transfer), cover), cover};
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

/// What a squared difference of half buffers and the variance of all samples tell.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE Spread<V> spread_of(D d, V difference2, V sample_variance) {
  const V zero = hn::Zero(d);
  const V error2 = hn::Mul(difference2, hn::Set(d, T(SampleErrorModel::half_difference_share)));
  const V variance = hn::Max(sample_variance, error2);
  // Not hn::Max: what is no number comes to nothing, too.
  return {hn::IfThenElseZero(hn::Gt(error2, zero), error2),
          hn::IfThenElseZero(hn::Gt(variance, zero), variance)};
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE V variance_of(D d, const V3<V>& all, const V3<V>& origin, V squares, std::size_t count) {
  const V whole = share_of(d, count);
  const V3<V> shift = sub(scale(all, whole), origin);
  return hn::MulSub(squares, whole, dot(shift, shift));
}

/// What the sums of a pixel's samples tell: of half buffer A, of all, and of the squares of their
/// differences from `origin`, one of them: squares of what is large leave nothing of what is small.
/// The halves are compared after the transfer.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Spread<V> spread_of(D d, const V3<V>& sum_a, const V3<V>& all, const V3<V>& origin,
                               V squares, std::size_t count, Transfer transfer) {
  const V half = share_of(d, count / 2);
  const auto shown = [&](const V3<V>& sum, V share)
                         HWY_ATTR { return resolved(d, max_zero(d, sum), share, transfer); };
  const V3<V> difference = sub(shown(sum_a, half), shown(sub(all, sum_a), half));
  return spread_of(d, dot(difference, difference), variance_of(d, all, origin, squares, count));
}

/// The same of an image that has a cover, which is a value like the others: samples of 0 and 1.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Spread<V> spread_of(D d, const CoveredColour<V>& sum_a, const CoveredColour<V>& all,
                               const V3<V>& origin, V squares, std::size_t count,
                               Transfer transfer) {
  const V half = share_of(d, count / 2);
  const auto shown = [&](const V3<V>& colour, V cover) HWY_ATTR {
    return resolved(d, CoveredColour<V>{max_zero(d, colour), cover}, half, transfer);
  };
  const CoveredColour<V> a = shown(sum_a.colour, sum_a.cover);
  const CoveredColour<V> b = shown(sub(all.colour, sum_a.colour), hn::Sub(all.cover, sum_a.cover));
  const V3<V> difference = sub(a.colour, b.colour);
  const V uncovered = hn::Sub(a.cover, b.cover);
  const V cover = hn::Mul(all.cover, share_of(d, count));
  return spread_of(d, hn::MulAdd(uncovered, uncovered, dot(difference, difference)),
                   hn::Add(variance_of(d, all.colour, origin, squares, count),
                           hn::NegMulAdd(cover, cover, cover)));
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
