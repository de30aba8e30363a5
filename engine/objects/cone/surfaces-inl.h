// Where packets have met cones: their normals and sides.

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// The normals, turned towards the rays' origins, where lanes met one cone. Of side and cap near
/// the rim it is the nearer one that faces the ray: the other cannot have been met from there.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE V3<V> normals_at(D d, const ConeItem<T>& item, const V3<V>& points,
                            const V3<V>& direction) {
  const V zero = hn::Zero(d);
  const V one = hn::Set(d, T(1));
  const Cones<V> c = in_all_lanes(d, item);
  const AlongCone<V> f = place_along(c, points);
  const AlongCone<V> g = direction_along(c, direction);
  const V square = hn::MulAdd(f.u, f.u, hn::Mul(f.v, f.v));
  const V inverse_length =
      hn::Div(one, hn::Sqrt(hn::Max(square, hn::Set(d, std::numeric_limits<T>::min()))));
  const V n_u = hn::Mul(f.u, inverse_length);
  const V n_v = hn::Mul(f.v, inverse_length);
  const V outwards = hn::MulSub(n_u, g.u, hn::NegMulAdd(n_v, g.v, g.girth));
  const V3<V> side =
      mul_add(c.across, n_u, mul_add(c.towards, n_v, scale(c.axis, hn::Neg(c.sine))));
  const M is_out = hn::Gt(outwards, zero);
  if (!(item.has_caps > 0)) return select(is_out, negate(side), side);
  // `low` is met by what goes along the axis.
  const M is_low = hn::Gt(g.w, zero);
  const V off_cap = hn::Abs(hn::Sub(f.w, hn::IfThenElse(is_low, c.low, c.high)));
  const V off_side = hn::Abs(hn::Sub(hn::Sqrt(square), f.girth));
  const M has_disc = hn::Gt(hn::IfThenElse(is_low, c.low_girth2, c.high_girth2), zero);
  const M is_cap = hn::And(has_disc, hn::Or(is_out, hn::Lt(off_cap, off_side)));
  return select(is_cap, scale(c.axis, hn::IfThenElse(is_low, hn::Neg(one), one)), side);
}

/// Lanes whose rays came to a closed cone from within: the nearest of its surfaces looks their way.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M is_met_from_within(D d, const ConeItem<T>& item, const V3<V>& points,
                                const V3<V>& direction) {
  const V zero = hn::Zero(d);
  const Cones<V> c = in_all_lanes(d, item);
  const AlongCone<V> f = place_along(c, points);
  const AlongCone<V> g = direction_along(c, direction);
  const V across = hn::Sqrt(hn::MulAdd(f.u, f.u, hn::Mul(f.v, f.v)));
  const V off_side = hn::Abs(hn::Sub(across, f.girth));
  const V nowhere = hn::Set(d, std::numeric_limits<T>::max());
  const auto off = [&](V end, V girth2) HWY_ATTR {  // a tip is none
    return hn::IfThenElse(hn::Gt(girth2, zero), hn::Abs(hn::Sub(f.w, end)), nowhere);
  };
  const V off_low = off(c.low, c.low_girth2);
  const V off_high = off(c.high, c.high_girth2);
  const V along_side = hn::NegMulAdd(across, g.girth, hn::MulAdd(f.u, g.u, hn::Mul(f.v, g.v)));
  const V along_cap = hn::IfThenElse(hn::Lt(off_low, off_high), hn::Neg(g.w), g.w);
  const M is_cap = hn::Lt(hn::Min(off_low, off_high), off_side);
  return hn::Gt(hn::IfThenElse(is_cap, along_cap, along_side), zero);
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
