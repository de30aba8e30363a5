// What shading needs of a hit: the point, the normal and the material.

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// What a packet has met, made ready for shading and for leaving it.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
struct Surface {
  RayOrigin<V> at;
  Rows<D, MaterialRow<T>> material;
};

/// The surfaces that the lanes of `is_hit` have hit, at least one, where they hit them.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE Surface<D> surface_at(D d, const PacketScene<T>& scene, const RayOrigin<V>& from,
                                 const V3<V>& direction, const Hit<V>& hit, M is_hit) {
  using Row = PrimitiveRow<T>;
  const Rows<D, Row> primitive(d, scene.primitives.data(), hit.id, is_hit);
  const V t = hn::IfThenElseZero(is_hit, hit.t);
  // Made where it is returned: copies of so large a structure wait for what was just stored.
  Surface<D> surface{{mul_add(direction, t, from.point), hit.normal, hit.id, hit.u, hit.v},
                     primitive.followed(d, &Row::material, scene.materials.rows.data(), is_hit)};
  RayOrigin<V>& at = surface.at;
  const V zero = hn::Zero(d);
  const V curvature = primitive(d, &Row::curvature);
  M own = hn::Lt(t, t);
  if (scene.has_own_normals) own = hn::And(is_hit, hn::Lt(curvature, zero));
  const M others = hn::AndNot(own, is_hit);
  if (!hn::AllFalse(d, others)) {
    const V3<V> place = primitive(d, &Row::place);
    V3<V> normal = scale(sub(at.point, place), curvature);
    if (scene.has_flat) {
      const M flat = hn::Eq(curvature, zero);
      const M ahead = hn::Gt(dot(place, direction), zero);
      normal = select(flat, select(ahead, negate(place), place), normal);
    }
    at.normal = scene.has_own_normals ? select(others, normal, at.normal) : normal;
  }
  if (scene.has_own_normals && !hn::AllFalse(d, own))
    for_each_geometry(scene,
                      [&]<class Kind>(const Geometry<Kind, T>& geometry) RAYTRACER_INLINE_ATTR {
                        if constexpr (HasOwnNormals<Kind>)
                          own_normals(d, scene.primitives, geometry, direction, own, at);
                      });
  return surface;
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
