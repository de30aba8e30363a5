// Refraction for packets of rays: as refracted() in reference.cpp.

#include <limits>

#include "engine/materials/material_row.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// How a packet goes on.
template <class V, class M>
struct RefractedRays {
  V3<V> direction;  ///< unit
  V reflectance;    ///< Fresnel's, of unpolarised light; 1 where all is reflected
  M is_total;       ///< all is reflected
};

/// Through surfaces whose normals face the rays; `index` is that of here over there.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE RefractedRays<V, M> refracted(D d, V index, const V3<V>& direction,
                                         const V3<V>& normal) {
  const V zero = hn::Zero(d);
  const V one = hn::Set(d, T(1));
  const V cosine = hn::Neg(dot(direction, normal));
  const V square = hn::NegMulAdd(hn::Mul(index, index), hn::NegMulAdd(cosine, cosine, one), one);
  const M goes_on = hn::Gt(square, zero);
  const V beyond = hn::Sqrt(hn::Max(square, zero));
  const V bent = hn::MulSub(index, cosine, beyond);
  const V least = hn::Set(d, std::numeric_limits<T>::min());
  const V across = hn::Div(bent, hn::Max(hn::MulAdd(index, cosine, beyond), least));
  const V along =
      hn::Div(hn::MulSub(index, beyond, cosine), hn::Max(hn::MulAdd(index, beyond, cosine), least));
  const V reflectance =
      hn::Mul(hn::Set(d, T(0.5)), hn::MulAdd(across, across, hn::Mul(along, along)));
  return {unit(d, mul_add(normal, bent, scale(direction, index))),
          hn::IfThenElse(goes_on, reflectance, one), hn::Not(goes_on)};
}

/// Through surfaces that `normal` shades: rays that this would not take to the other side take
/// `surface_normal`.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE RefractedRays<V, M> refracted(D d, V index, const V3<V>& direction, const V3<V>& normal,
                                         const V3<V>& surface_normal) {
  const V zero = hn::Zero(d);
  const RefractedRays<V, M> smooth = refracted(d, index, direction, normal);
  const M through = hn::Or(smooth.is_total, hn::Lt(dot(smooth.direction, surface_normal), zero));
  const M serves = hn::And(hn::Lt(dot(direction, normal), zero), through);
  const RefractedRays<V, M> flat = refracted(d, index, direction, surface_normal);
  return {select(serves, smooth.direction, flat.direction),
          hn::IfThenElse(serves, smooth.reflectance, flat.reflectance),
          hn::Or(hn::And(serves, smooth.is_total), hn::AndNot(serves, flat.is_total))};
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
