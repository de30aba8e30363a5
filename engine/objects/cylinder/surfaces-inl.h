// Where packets have met cylinders: their normals and sides.

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// The normals, turned towards the rays' origins, where lanes met one cylinder. Of side and cap
/// near the rim it is the nearer one that faces the ray: the other cannot have been met from there.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE V3<V> normals_at(D d, const CylinderItem<T>& item, const V3<V>& points,
                            const V3<V>& direction) {
  const V zero = hn::Zero(d);
  const V one = hn::Set(d, T(1));
  const Cylinders<V> c = in_all_lanes(d, item);
  const InAxes<V> f = place_along(c, points);
  const InAxes<V> g = direction_along(c, direction);
  const V square = hn::MulAdd(f.u, f.u, hn::Mul(f.v, f.v));
  const V inverse_length = hn::Div(one, hn::Sqrt(square));
  InAxes<V> n{hn::Mul(f.u, inverse_length), hn::Mul(f.v, inverse_length), zero};
  const V outwards = hn::MulAdd(n.u, g.u, hn::Mul(n.v, g.v));
  if (item.has_caps > 0) {
    // `low` is met by what goes along the axis.
    const M is_low = hn::Gt(g.w, zero);
    const V off_cap = hn::Abs(hn::Sub(f.w, hn::IfThenElse(is_low, c.low, c.high)));
    const V off_side = hn::Abs(hn::Sub(hn::Sqrt(square), hn::Sqrt(c.radius2)));
    const M is_cap = hn::Or(hn::Gt(outwards, zero), hn::Lt(off_cap, off_side));
    n = {hn::IfThenZeroElse(is_cap, n.u), hn::IfThenZeroElse(is_cap, n.v),
         hn::IfThenElseZero(is_cap, hn::IfThenElse(is_low, hn::Neg(one), one))};
  } else {
    const M is_inside = hn::Gt(outwards, zero);
    n = {hn::IfThenElse(is_inside, hn::Neg(n.u), n.u), hn::IfThenElse(is_inside, hn::Neg(n.v), n.v),
         zero};
  }
  return mul_add(c.across, n.u, mul_add(c.towards, n.v, scale(c.axis, n.w)));
}

/// Lanes whose rays came to a closed cylinder from within: the nearest of its surfaces looks their
/// way.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M is_met_from_within(D d, const CylinderItem<T>& item, const V3<V>& points,
                                const V3<V>& direction) {
  const Cylinders<V> c = in_all_lanes(d, item);
  const InAxes<V> f = place_along(c, points);
  const InAxes<V> g = direction_along(c, direction);
  const V radius = hn::Sqrt(hn::MulAdd(f.u, f.u, hn::Mul(f.v, f.v)));
  const V off_side = hn::Abs(hn::Sub(radius, hn::Sqrt(c.radius2)));
  const V off_low = hn::Abs(hn::Sub(f.w, c.low));
  const V off_high = hn::Abs(hn::Sub(f.w, c.high));
  const V along_side = hn::MulAdd(f.u, g.u, hn::Mul(f.v, g.v));
  const V along_cap = hn::IfThenElse(hn::Lt(off_low, off_high), hn::Neg(g.w), g.w);
  const M is_cap = hn::Lt(hn::Min(off_low, off_high), off_side);
  return hn::Gt(hn::IfThenElse(is_cap, along_cap, along_side), hn::Zero(d));
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
