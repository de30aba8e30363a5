// Blinn-Phong for a packet of points.

#if defined(RAYTRACER_KERNEL_SIMD_SHADE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_SHADE_INL_H_
#undef RAYTRACER_KERNEL_SIMD_SHADE_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_SHADE_INL_H_
#endif

#include <hwy/contrib/math/math-inl.h>

#include <limits>

#include "engine/kernel/simd/packet-inl.h"
#include "engine/kernel/simd/power-inl.h"
#include "engine/kernel/simd/rays-inl.h"
#include "engine/kernel/simd/shade_plain-inl.h"
#include "engine/kernel/simd/surface-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// cosine^shininess with 1 - cosine given apart, which keeps its digits where the cosine has
/// lost them: exp(shininess log1p(-versine)); 0^0 = 1.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V power(D d, V versine, V shininess) {
  using T = hn::TFromD<D>;
  const V one = hn::Set(d, T(1));
  const auto faces = hn::Lt(versine, one);
  const V logarithm = hn::Log1p(d, hn::IfThenElseZero(faces, hn::Neg(versine)));
  // Far below the least number that exp() is made for, and as dark.
  const V lowest = hn::Set(d, T(-80));
  const V exponent = hn::Mul(shininess, logarithm);
  const V result = hn::IfThenElseZero(hn::And(faces, hn::Gt(exponent, lowest)),
                                      hn::Exp(d, hn::Max(exponent, lowest)));
  return hn::IfThenElse(hn::Eq(shininess, hn::Zero(d)), one, result);
}

/// (h . n)^shininess, h the direction halfway between light and eye.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V highlight(D d, const SimdScene<T>& scene, const Surface<D>& surface,
                       const V3<V>& towards, const V3<V>& view) {
  const V3<V> sum = add(towards, view);
  if (scene.uniform_shininess >= 0) {
    // By the cosine's square, which needs no root.
    const V along = hn::Max(dot(sum, surface.at.normal), hn::Zero(d));
    const V square = hn::Mul(hn::Mul(along, along), inverse(d, dot(sum, sum)));
    const V cosine2 = hn::Min(square, hn::Set(d, T(1)));
    return power_of_root(d, cosine2, scene.uniform_shininess);
  }
  const V3<V> half = unit(d, sum);
  const V3<V> chord = sub(half, surface.at.normal);
  const V versine = hn::Mul(hn::Set(d, T(0.5)), dot(chord, chord));
  return power(d, versine, surface.material(d, scene.materials.shininess));
}

/// The colour of the packet's points under any light; rubbish in lanes not `active`.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE V3<V> shade_fully(D d, const SimdScene<T>& scene, const Surface<D>& surface,
                               const V3<V>& view, M active) {
  const MaterialTable<T>& table = scene.materials;
  const Start<V>& point = surface.at;
  const V zero = hn::Zero(d);
  const V one = hn::Set(d, T(1));
  const V ambient = surface.material(d, table.ambient);
  const V kd = surface.material(d, table.kd);
  const V ks = surface.material(d, table.ks);
  const V most = hn::Set(d, std::numeric_limits<T>::max() / T(1e6));
  const bool ambient_needs_light = scene.shadows == Shadows::black;

  const V start = ambient_needs_light ? zero : ambient;
  V3<V> sum{start, start, start};
  for (const SimdLight<T>& light : scene.lights) {
    V3<V> towards = broadcast(d, light.place);
    V3<V> emission = broadcast(d, light.emission);
    V distance = hn::Set(d, std::numeric_limits<T>::max());
    if (!light.is_distant) {
      const V3<V> path = sub(towards, point.point);
      const V square = dot(path, path);
      const V inverse = hn::Div(one, hn::Max(square, hn::Set(d, std::numeric_limits<T>::min())));
      distance = hn::Sqrt(square);
      towards = scale(path, hn::Sqrt(inverse));
      emission = {hn::Min(hn::Mul(emission.x, inverse), most),
                  hn::Min(hn::Mul(emission.y, inverse), most),
                  hn::Min(hn::Mul(emission.z, inverse), most)};
    }
    const V incidence = dot(point.normal, towards);
    M lit = hn::And(active, hn::Gt(incidence, zero));
    if (hn::AllFalse(d, lit)) continue;
    if (scene.shadows != Shadows::off) {
      lit = hn::AndNot(occluded(d, scene, light, point, towards, distance, incidence, lit), lit);
      if (hn::AllFalse(d, lit)) continue;
    }

    V share = hn::Mul(kd, incidence);
    if (scene.has_specular)
      share = hn::MulAdd(ks, highlight(d, scene, surface, towards, view), share);
    const V base = ambient_needs_light ? ambient : zero;
    sum.x = hn::Add(sum.x, hn::IfThenElseZero(lit, hn::MulAdd(share, emission.x, base)));
    sum.y = hn::Add(sum.y, hn::IfThenElseZero(lit, hn::MulAdd(share, emission.y, base)));
    sum.z = hn::Add(sum.z, hn::IfThenElseZero(lit, hn::MulAdd(share, emission.z, base)));
  }
  return {hn::Mul(sum.x, surface.material(d, table.red)),
          hn::Mul(sum.y, surface.material(d, table.green)),
          hn::Mul(sum.z, surface.material(d, table.blue))};
}

/// The colour of the packet's points, without what they mirror; rubbish in lanes not `active`.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE V3<V> shade(D d, const SimdScene<T>& scene, const Surface<D>& surface, const V3<V>& view,
                       M active) {
  if (scene.is_plainly_lit && HWY_LIKELY(!is_among_squares(d, scene, surface.at, active)))
    return shade_plainly(d, scene, surface, view, active);
  return shade_fully(d, scene, surface, view, active);
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
