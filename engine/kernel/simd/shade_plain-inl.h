// Blinn-Phong under the plainest light: distant, shadows by a few spheres and by the neighbours in
// a square, one exponent for all highlights.
//
// As shade_fully() has it, which models everything; here what does not depend on the light is
// computed once, and nothing in the loop over the lights calls a function, for which g++ would keep
// every vector in memory.

#if defined(RAYTRACER_KERNEL_SIMD_SHADE_PLAIN_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_SHADE_PLAIN_INL_H_
#undef RAYTRACER_KERNEL_SIMD_SHADE_PLAIN_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_SHADE_PLAIN_INL_H_
#endif

#include "engine/kernel/simd/packet-inl.h"
#include "engine/kernel/simd/power-inl.h"
#include "engine/kernel/simd/square-inl.h"
#include "engine/kernel/simd/surface-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// Whether a lane of `active` leaves a sphere of a square so near its rim that a neighbour which
/// could shadow it may be missing.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE bool is_near_rim(D d, const SimdScene<T>& scene, const Start<V>& from, M active) {
  for (const SimdSquare<T>& square : scene.squares) {
    const M inner = hn::And(hn::And(hn::Ge(from.first, hn::Set(d, square.inner_low_first)),
                                    hn::Le(from.first, hn::Set(d, square.inner_high_first))),
                            hn::And(hn::Ge(from.second, hn::Set(d, square.inner_low_second)),
                                    hn::Le(from.second, hn::Set(d, square.inner_high_second))));
    const M leaves = hn::And(active, hn::Eq(from.id, hn::Set(d, square.id)));
    if (!hn::AllFalse(d, hn::AndNot(inner, leaves))) return true;
  }
  return false;
}

/// Whether light from something else than a square may have to pass a square.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE bool is_among_squares(D d, const SimdScene<T>& scene, const Start<V>& from, M active) {
  for (const SimdSquare<T>& square : scene.squares) {
    const M others = hn::AndNot(hn::Eq(from.id, hn::Set(d, square.id)), active);
    if (hn::AllFalse(d, others)) continue;
    const V height = hn::MulAdd(along_square(square, from.point).y,
                                hn::Set(d, square.cells_per_unit), hn::Set(d, square.eye.y));
    const M is_clear = hn::Or(hn::Ge(height, hn::Set(d, square.clear_above)),
                              hn::Le(height, hn::Set(d, square.clear_below)));
    if (!hn::AllFalse(d, hn::AndNot(is_clear, others))) return true;
  }
  return false;
}

/// Lanes of `lit` from which something stands before the distant light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M plainly_occluded(D d, const SimdScene<T>& scene, const SimdLight<T>& light,
                              const Start<V>& from, const V3<V>& towards, V incidence,
                              bool near_rim, M lit) {
  M dark = hn::Lt(incidence, incidence);
  const V u = dot(from.point, broadcast(d, light.across[0]));
  const V v = dot(from.point, broadcast(d, light.across[1]));
  const V w = dot(from.point, towards);
  for (const LightDisc<T>& disc : light.discs) {
    const V du = hn::Sub(u, hn::Set(d, disc.u));
    const V dv = hn::Sub(v, hn::Set(d, disc.v));
    const V distance2 = hn::MulAdd(du, du, hn::Mul(dv, dv));
    const M before = hn::And(hn::Lt(w, hn::Set(d, disc.w)), hn::Ne(from.id, hn::Set(d, disc.id)));
    dark = hn::Or(dark, hn::And(before, hn::Le(distance2, hn::Set(d, disc.radius2))));
  }
  const Stencil<T>* stencil = light.stencils.data();
  for (const SimdSquare<T>& square : scene.squares) {
    const M leaves = hn::Eq(from.id, hn::Set(d, square.id));
    const M neighbours = hn::And(lit, leaves);
    if (!hn::AllFalse(d, neighbours)) {
      const V3<V> normal = along_square(square, from.normal);
      if (HWY_UNLIKELY(near_rim))
        dark = hn::Or(dark, shadowed_by_neighbours(d, square, *stencil, from.first, from.second,
                                                   normal, incidence, neighbours));
      else
        dark = hn::Or(dark, hn::And(neighbours, shadowed_amid(d, *stencil, normal, incidence)));
    }
    ++stencil;
  }
  return dark;
}

/// The colour of the packet's points, not among squares, where the light is plain; rubbish in lanes
/// not `active`.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE V3<V> shade_plainly(D d, const SimdScene<T>& scene, const Surface<D>& surface,
                               const V3<V>& view, M active) {
  const Start<V>& point = surface.at;
  const V zero = hn::Zero(d);
  const V one = hn::Set(d, T(1));
  const Finish<V> finish = surface.material.finish(d, scene.materials);
  const V facing = dot(view, point.normal);
  const bool has_shadows = scene.shadows != Shadows::off;
  const bool near_rim = has_shadows && is_near_rim(d, scene, point, active);
  const bool ambient_needs_light = scene.shadows == Shadows::black;

  V ambient = ambient_needs_light ? zero : finish.ambient;
  V3<V> sum{zero, zero, zero};
  for (const SimdLight<T>& light : scene.lights) {
    const V3<V> towards = broadcast(d, light.place);
    const V incidence = dot(point.normal, towards);
    M lit = hn::And(active, hn::Gt(incidence, zero));
    if (hn::AllFalse(d, lit)) continue;
    if (has_shadows) {
      lit = hn::AndNot(plainly_occluded(d, scene, light, point, towards, incidence, near_rim, lit),
                       lit);
      if (hn::AllFalse(d, lit)) continue;
    }

    V share = hn::Mul(finish.kd, incidence);
    if (scene.has_specular) {
      // By the square of the cosine of the angle with the direction halfway to the eye.
      const V3<V> halfway = add(towards, view);
      const V along = hn::Max(hn::Add(incidence, facing), zero);
      const V square = hn::Mul(hn::Mul(along, along), inverse(d, dot(halfway, halfway)));
      const V cosine2 = hn::Min(square, one);
      share = hn::MulAdd(finish.ks, power_of_root(d, cosine2, scene.uniform_shininess), share);
    }
    share = hn::IfThenElseZero(lit, share);
    if (ambient_needs_light) ambient = hn::Add(ambient, hn::IfThenElseZero(lit, finish.ambient));
    sum = mul_add(broadcast(d, light.emission), share, sum);
  }
  const V3<V> colour = surface.material.colour(d, scene.materials);
  return {hn::Mul(hn::Add(sum.x, ambient), colour.x), hn::Mul(hn::Add(sum.y, ambient), colour.y),
          hn::Mul(hn::Add(sum.z, ambient), colour.z)};
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
