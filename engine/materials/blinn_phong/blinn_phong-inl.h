// Blinn-Phong for packets of points.

#if defined(RAYTRACER_MATERIALS_BLINN_PHONG_BLINN_PHONG_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_MATERIALS_BLINN_PHONG_BLINN_PHONG_INL_H_
#undef RAYTRACER_MATERIALS_BLINN_PHONG_BLINN_PHONG_INL_H_
#else
#define RAYTRACER_MATERIALS_BLINN_PHONG_BLINN_PHONG_INL_H_
#endif

#include <hwy/contrib/math/math-inl.h>

#include <cstdint>

#include "engine/kernel/simd/surface-inl.h"

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

/// What does not depend on a light.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
struct BlinnPhongPacket {
  const Surface<D>& surface;
  V3<V> view;  ///< unit, towards the viewer
  V facing;    ///< view . normal
  V ambient;   ///< ka times the scene's
  V kd;
  V ks;

  HWY_INLINE BlinnPhongPacket(D d, const PacketScene<T>& scene, const Surface<D>& at,
                              const V3<V>& towards_viewer)
      : surface(at), view(towards_viewer), facing(dot(view, at.at.normal)) {
    const Finish<V> finish = at.material.finish(d, scene.materials);
    ambient = finish.ambient;
    kd = finish.kd;
    ks = finish.ks;
  }

  /// kd (N.L) + ks max(0, H.N)^shininess, for N.L > 0.
  HWY_INLINE V share(D d, const PacketScene<T>& scene, const V3<V>& towards, V incidence) const {
    const V diffuse = hn::Mul(kd, incidence);
    if (!scene.has_specular) return diffuse;
    return hn::MulAdd(ks, highlight(d, scene, towards, incidence), diffuse);
  }

 private:
  HWY_INLINE V highlight(D d, const PacketScene<T>& scene, const V3<V>& towards,
                         V incidence) const {
    const V3<V> halfway = add(towards, view);
    if (scene.uniform_shininess < 0) return varied_highlight(d, scene, halfway);
    // By the square of the cosine of the angle with the direction halfway to the eye: without a
    // root.
    const V along = hn::Max(hn::Add(incidence, facing), hn::Zero(d));
    const V square = hn::Mul(hn::Mul(along, along), inverse(d, dot(halfway, halfway)));
    return power_of_root(d, hn::Min(square, hn::Set(d, T(1))), scene.uniform_shininess);
  }

  HWY_NOINLINE V varied_highlight(D d, const PacketScene<T>& scene, const V3<V>& halfway) const {
    const V3<V> chord = sub(unit(d, halfway), surface.at.normal);
    const V versine = hn::Mul(hn::Set(d, T(0.5)), dot(chord, chord));
    return power(d, versine, surface.material(d, scene.materials.shininess));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
