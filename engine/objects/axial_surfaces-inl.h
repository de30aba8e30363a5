// Where packets have met surfaces of revolution: their normals and sides, item by item, and
// where exactly.
// A kind's own code, which comes before this file, brings
//
//   normals_at(d, item, points, direction)          where lanes met one, towards the rays' origins
//   is_met_from_within(d, item, points, direction)  of a closed one: lanes that came from inside

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Sets the normals of the lanes of `own` that hit one of them.
template <class D, AxialKind Kind, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_NOINLINE void own_normals(D d, const PrimitiveRows<T>& rows, const Geometry<Kind, T>& solids,
                              const V3<V>& direction, M own, RayOrigin<V>& at) {
  set_item_normals(d, rows, solids.items, own, at, [&](const auto& item) HWY_ATTR {
    return normals_at(d, item, at.point, direction);
  });
}

/// Sets the distances at which the rays of the lanes of `own` meet those that they are known to
/// hit.
template <class D, AxialKind Kind, class Origin, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_NOINLINE void own_distances(D d, const PrimitiveRows<T>& rows, const Geometry<Kind, T>& solids,
                                const Origin& from, const V3<V>& direction, M own, Hit<V>& hit) {
  for_each_item(d, rows, solids.items, own, hit.id, [&](const auto& item, M here) HWY_ATTR {
    // What it leaves it leaves from the same surface, whose normal was told in single.
    Origin exact = from;
    const M leaves = hn::And(here, hn::Eq(from.id, hit.id));
    if (!hn::AllFalse(d, leaves)) {
      const V3<V> normal = normals_at(d, item, from.point, direction);
      const M is_opposite = hn::Lt(dot(normal, from.normal), hn::Zero(d));
      exact.normal = select(leaves, select(is_opposite, negate(normal), normal), exact.normal);
    }
    V t;
    const M is_hit = intersect(d, in_all_lanes(d, item), exact, direction, here, t);
    hit.t = hn::IfThenElse(is_hit, t, hit.t);
  });
}

/// Tells of the lanes of `own` that hit one of them on which side, as tell_sides() has it; those of
/// `within` may have come from inside of something.
template <class D, AxialKind Kind, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_NOINLINE void own_sides(D d, const PrimitiveRows<T>& rows, const Geometry<Kind, T>& solids,
                            const V3<V>& direction, M own, M within, RayOrigin<V>& at, V& side) {
  for_each_item(d, rows, solids.items, own, at.id, [&](const auto& item, M here) HWY_ATTR {
    side = hn::IfThenElse(here, hn::Set(d, T(item.has_caps - 1)), side);
    if (!(item.has_caps > 0)) return;
    const M leaves =
        hn::And(hn::And(here, within), is_met_from_within(d, item, at.point, direction));
    if (hn::AllFalse(d, leaves)) return;
    // As it would be met by a ray that goes back.
    const V3<V> outwards = normals_at(d, item, at.point, negate(direction));
    at.normal = select(leaves, negate(outwards), at.normal);
    side = hn::IfThenElse(leaves, hn::Set(d, T(1)), side);
  });
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
