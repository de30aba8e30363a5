// What shading needs of a hit: the point, the normal and the material.

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Where a packet has met surfaces.
template <class V>
struct Meeting {
  V3<V> point;
  V3<V> normal;
  V3<V> shading_normal;  ///< the same, or what the corners around the point tell
};

/// What a packet has met, made ready for shading and for leaving it.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
struct Surface {
  RayOrigin<V> at;
  Rows<D, MaterialRow<T>> material;
  V3<V> normal;  ///< that shades: at.normal, or what the corners around the point tell
  V3<V> color;   ///< the material's, or likewise

  HWY_INLINE Meeting<V> meeting() const { return {at.point, at.normal, normal}; }
};

/// The normals of what is round, or flat, that rays have met in points; its row tells `place` and
/// `curvature`.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V3<V> normal_by_row(D d, const PacketScene<T>& scene, const V3<V>& place, V curvature,
                               const V3<V>& point, const V3<V>& direction) {
  V3<V> normal = scale(sub(point, place), curvature);
  if (scene.has_flat) {
    const auto flat = hn::Eq(curvature, hn::Zero(d));
    const auto ahead = hn::Gt(dot(place, direction), hn::Zero(d));
    // One by one, not as a vector: that would be kept in memory.
    const auto take = [&](V of_flat, V& of_round) HWY_ATTR {
      of_round = hn::IfThenElse(flat, hn::IfThenElse(ahead, hn::Neg(of_flat), of_flat), of_round);
    };
    take(place.x, normal.x);
    take(place.y, normal.y);
    take(place.z, normal.z);
  }
  return normal;
}

/// Takes the normals and colours of the lanes of `is_hit` whose corners tell them. `place` is of
/// rows of primitives.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE void take_from_corners(D d, const PacketScene<T>& scene,
                                    const Rows<D, PrimitiveRow<T>>& primitive, const V3<V>& point,
                                    const V3<V>& direction, M is_hit, V3<V>& shading_normal,
                                    V3<V>& shading_color) {
  using Row = CornerRow<T>;
  const V zero = hn::Zero(d);
  const V one = hn::Set(d, T(1));
  const V item = primitive(d, &PrimitiveRow<T>::item);
  const M flat = hn::Eq(primitive(d, &PrimitiveRow<T>::curvature), zero);
  const M told = hn::And(hn::And(is_hit, flat), hn::Gt(item, zero));
  if (hn::AllFalse(d, told)) return;
  const Rows<D, Row> row(d, scene.corners.data(), hn::Sub(item, one), told);
  const auto weight = [&](Triple<T> Row::*slope, T Row::*offset) HWY_ATTR {
    const V at = hn::Add(dot(row(d, slope), point), row(d, offset));
    return hn::Min(hn::Max(at, zero), one);
  };
  const V b = weight(&Row::b_slope, &Row::b_offset);
  const V c = weight(&Row::c_slope, &Row::c_offset);
  const auto between =
      [&](Triple<T> Row::*of_a, Triple<T> Row::*of_b, Triple<T> Row::*of_c)
          HWY_ATTR { return mul_add(row(d, of_b), b, mul_add(row(d, of_c), c, row(d, of_a))); };
  const M has_normals = hn::And(told, hn::Gt(row(d, &Row::has_normals), zero));
  if (!hn::AllFalse(d, has_normals)) {
    const V3<V> normal = between(&Row::normal, &Row::b_normal, &Row::c_normal);
    const V square = dot(normal, normal);
    const V length = hn::Sqrt(hn::Max(square, hn::Set(d, std::numeric_limits<T>::min())));
    // Turned with the geometric one, whose opposite the row has.
    const M is_back = hn::Lt(dot(primitive(d, &PrimitiveRow<T>::place), direction), zero);
    const V scale_to_unit = hn::Div(hn::IfThenElse(is_back, hn::Neg(one), one), length);
    shading_normal = select(hn::And(has_normals, hn::Gt(square, zero)),
                            scale(normal, scale_to_unit), shading_normal);
  }
  const M has_colors = hn::And(told, hn::Gt(row(d, &Row::has_colors), zero));
  if (hn::AllFalse(d, has_colors)) return;
  shading_color =
      select(has_colors, between(&Row::color, &Row::b_color, &Row::c_color), shading_color);
}

/// The surfaces that the lanes of `is_hit` have hit, at least one, where they hit them.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE Surface<D> surface_at(D d, const PacketScene<T>& scene, const RayOrigin<V>& from,
                                 const V3<V>& direction, const Hit<V>& hit, M is_hit) {
  using Row = PrimitiveRow<T>;
  const Rows<D, Row> primitive(d, scene.primitives.data(), hit.id, is_hit);
  const V t = hn::IfThenElseZero(is_hit, hit.t);
  // Made where it is returned: copies of so large a structure wait for what was just stored.
  Surface<D> surface{{mul_add(direction, t, from.point), hit.normal, hit.id, hit.u, hit.v},
                     primitive.followed(d, &Row::material, scene.materials.rows.data(), is_hit),
                     hit.normal,
                     hit.normal};
  surface.color = surface.material(d, &MaterialRow<T>::color);
  RayOrigin<V>& at = surface.at;
  const V zero = hn::Zero(d);
  const V curvature = primitive(d, &Row::curvature);
  M own = hn::Lt(t, t);
  if (scene.has_own_normals) own = hn::And(is_hit, hn::Lt(curvature, zero));
  const M others = hn::AndNot(own, is_hit);
  if (!hn::AllFalse(d, others)) {
    const V3<V> place = primitive(d, &Row::place);
    const V3<V> normal = normal_by_row(d, scene, place, curvature, at.point, direction);
    at.normal = scene.has_own_normals ? select(others, normal, at.normal) : normal;
  }
  if (scene.has_own_normals && !hn::AllFalse(d, own))
    for_each_geometry(scene,
                      [&]<class Kind>(const Geometry<Kind, T>& geometry) RAYTRACER_INLINE_ATTR {
                        if constexpr (HasOwnNormals<Kind>)
                          own_normals(d, scene.primitives, geometry, direction, own, at);
                      });
  surface.normal = at.normal;
  if (!scene.corners.empty())
    take_from_corners(d, scene, primitive, at.point, direction, is_hit, surface.normal,
                      surface.color);
  return surface;
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
