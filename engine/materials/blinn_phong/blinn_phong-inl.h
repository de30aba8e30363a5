// Blinn-Phong for packets of points.

#include <hwy/contrib/math/math-inl.h>

#include <cstdint>

#include "engine/materials/material_row.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// x^floor(exponent / 2) for x in [0, 1], by squaring from the exponents' highest bit; 0^0 = 1.
/// Each lane's is what it would be by itself: squares of 1 are 1.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V power_of_half(D d, V x, hn::Vec<hn::RebindToUnsigned<D>> exponent,
                           const IntegerExponents& of_scene) {
  const hn::RebindToUnsigned<D> bits;
  const V one = hn::Set(d, hn::TFromD<D>(1));
  // x in the lanes whose exponent has the bit, which some of the scene's have; in the others 1.
  const auto or_one = [&](std::uint32_t bit) HWY_ATTR {
    if ((of_scene.all & bit) != 0) return x;
    const auto has_bit = hn::TestBit(exponent, hn::Set(bits, bit));
    return hn::IfThenElse(hn::RebindMask(d, has_bit), x, one);
  };
  if (of_scene.any <= 1) return one;
  std::uint32_t bit = std::uint32_t{1} << (31 - hwy::Num0BitsAboveMS1Bit_Nonzero32(of_scene.any));
  V power = or_one(bit);
  while ((bit >>= 1U) > 1) {
    power = hn::Mul(power, power);
    if ((of_scene.any & bit) != 0) power = hn::Mul(power, or_one(bit));
  }
  return power;
}

/// sqrt(square)^shininess, likewise: only odd exponents need the root.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V power_of_root(D d, V square, V shininess, const IntegerExponents& of_scene) {
  using T = hn::TFromD<D>;
  const hn::RebindToUnsigned<D> bits;
  // An integer's bits are then the lowest of the number's.
  const V raised = hn::Add(shininess, hn::Set(d, hwy::MantissaEnd<T>()));
  const auto exponent = hn::BitCast(bits, raised);
  const V power = power_of_half(d, square, exponent, of_scene);
  if ((of_scene.any & 1) == 0) return power;
  if ((of_scene.all & 1) != 0) return hn::Mul(power, hn::Sqrt(square));
  const auto is_odd = hn::RebindMask(d, hn::TestBit(exponent, hn::Set(bits, 1)));
  return hn::IfThenElse(is_odd, hn::Mul(power, hn::Sqrt(square)), power);
}

/// cosine^shininess with 1 - cosine given apart, which keeps its digits where the cosine has
/// lost them: exp(shininess log1p(-versine)); 0^0 = 1.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V power(D d, V versine, V shininess) {
  using T = hn::TFromD<D>;
  const V one = hn::Set(d, T(1));
  const auto faces = hn::Lt(versine, one);
  const V logarithm = hn::Log1p(d, hn::IfThenElseZero(faces, hn::Neg(versine)));
  // exp(-80) is 2e-35: black, and still a normal float.
  const V lowest = hn::Set(d, T(-80));
  const V exponent = hn::Mul(shininess, logarithm);
  const V result = hn::IfThenElseZero(hn::And(faces, hn::Gt(exponent, lowest)),
                                      hn::Exp(d, hn::Max(exponent, lowest)));
  return hn::IfThenElse(hn::Eq(shininess, hn::Zero(d)), one, result);
}

/// How surfaces answer light: what does not depend on the light.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
class BlinnPhongPacket {
 public:
  V ambient;  ///< ka times the scene's

  /// `view` is unit, towards the viewer; all are referred to.
  HWY_INLINE BlinnPhongPacket(D d, const PacketMaterials<T>& materials,
                              const Rows<D, MaterialRow<T>>& rows, const V3<V>& normal,
                              const V3<V>& view)
      : ambient(rows(d, &MaterialRow<T>::ambient)),
        materials_(materials),
        rows_(rows),
        normal_(normal),
        view_(view),
        kd_(rows(d, &MaterialRow<T>::kd)),
        ks_(rows(d, &MaterialRow<T>::ks)),
        shines_(materials.has_specular && !hn::AllTrue(d, hn::Eq(ks_, hn::Zero(d)))) {}

  /// kd: what a sky makes shine.
  HWY_INLINE V diffuse() const { return kd_; }

  /// kd (N.L) + ks max(0, H.N)^shininess, for N.L > 0.
  HWY_INLINE V share(D d, const V3<V>& towards, V incidence) const {
    const V diffuse = hn::Mul(kd_, incidence);
    if (!shines_) return diffuse;
    return hn::MulAdd(ks_, highlight(d, towards), diffuse);
  }

 private:
  HWY_INLINE V highlight(D d, const V3<V>& towards) const {
    const V3<V> halfway = add(towards, view_);
    if (!materials_.integer_shininess.are_all) return highlight_of_any(d, halfway);
    // By the square of the cosine of the angle with the direction halfway to the eye: without a
    // root.
    const V along = hn::Max(dot(halfway, normal_), hn::Zero(d));
    const V square = hn::Mul(hn::Mul(along, along), inverse(d, dot(halfway, halfway)));
    return power_of_root(d, hn::Min(square, hn::Set(d, T(1))), rows_(d, &MaterialRow<T>::shininess),
                         materials_.integer_shininess);
  }

  HWY_NOINLINE V highlight_of_any(D d, const V3<V>& halfway) const {
    const V3<V> chord = sub(unit(d, halfway), normal_);
    const V versine = hn::Mul(hn::Set(d, T(0.5)), dot(chord, chord));
    return power(d, versine, rows_(d, &MaterialRow<T>::shininess));
  }

  const PacketMaterials<T>& materials_;
  const Rows<D, MaterialRow<T>>& rows_;
  const V3<V>& normal_;
  const V3<V> view_;
  V kd_;
  V ks_;
  bool shines_;  ///< has a highlight in some lane
};

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
