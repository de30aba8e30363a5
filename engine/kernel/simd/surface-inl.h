// What shading needs of a hit: the point, the normal and the material.

#if defined(RAYTRACER_KERNEL_SIMD_SURFACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_SURFACE_INL_H_
#undef RAYTRACER_KERNEL_SIMD_SURFACE_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_SURFACE_INL_H_
#endif

#include "engine/kernel/simd/find-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// What a material does with light.
template <class V>
struct Finish {
  V ambient;
  V kd;
  V ks;
};

/// The row of a table that each lane asks for. Neighbouring pixels mostly show the same thing: then
/// nothing is gathered.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
class Rows {
 public:
  using VI = hn::Vec<hn::RebindToSigned<D>>;

  /// `rows` counts in the lanes of `active`, at least one.
  HWY_INLINE Rows(D d, V rows, M active) {
    HWY_ALIGN T lanes[hn::MaxLanes(D())];
    hn::Store(rows, d, lanes);
    const T first = lanes[hn::FindFirstTrue(d, active)];
    is_shared_ = hn::AllTrue(d, hn::Or(hn::Not(active), hn::Eq(rows, hn::Set(d, first))));
    shared_ = static_cast<std::size_t>(first);
    rows_ = hn::ConvertTo(hn::RebindToSigned<D>(), hn::IfThenElseZero(active, rows));
  }

  HWY_INLINE V operator()(D d, const Column<const T>& column) const {
    if (is_shared_) return hn::Set(d, column[shared_]);
    return hn::GatherIndex(d, column.data(), rows_);
  }

  /// The rows that the column names.
  HWY_INLINE Rows followed(D d, const Column<const T>& column, M active) const {
    if (HWY_LIKELY(is_shared_)) return Rows(d, column[shared_]);
    return Rows(d, hn::GatherIndex(d, column.data(), rows_), active);
  }

  HWY_INLINE Finish<V> finish(D d, const MaterialTable<T>& table) const {
    if (HWY_LIKELY(is_shared_))
      return {hn::Set(d, table.ambient[shared_]), hn::Set(d, table.kd[shared_]),
              hn::Set(d, table.ks[shared_])};
    return {hn::GatherIndex(d, table.ambient.data(), rows_),
            hn::GatherIndex(d, table.kd.data(), rows_), hn::GatherIndex(d, table.ks.data(), rows_)};
  }
  HWY_INLINE V3<V> colour(D d, const MaterialTable<T>& table) const {
    if (HWY_LIKELY(is_shared_))
      return {hn::Set(d, table.red[shared_]), hn::Set(d, table.green[shared_]),
              hn::Set(d, table.blue[shared_])};
    return {hn::GatherIndex(d, table.red.data(), rows_),
            hn::GatherIndex(d, table.green.data(), rows_),
            hn::GatherIndex(d, table.blue.data(), rows_)};
  }

 private:
  HWY_INLINE Rows(D, T row)
      : rows_(hn::Zero(hn::RebindToSigned<D>())),
        shared_(static_cast<std::size_t>(row)),
        is_shared_(true) {}

  VI rows_;
  std::size_t shared_;
  bool is_shared_;
};

/// What a packet has met, made ready for shading and for leaving it.
template <class D, class V = hn::Vec<D>>
struct Surface {
  RayOrigin<V> at;
  Rows<D> material;
};

/// The surfaces that the lanes of `is_hit` have hit, at least one, where they hit them.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE Surface<D> surface_at(D d, const PacketScene<T>& scene, const RayOrigin<V>& from,
                                 const V3<V>& direction, const Hit<V>& hit, M is_hit) {
  using Table = PrimitiveTable<T>;
  const Table& table = scene.primitives;
  const V rows = hn::Mul(hit.id, hn::Set(d, static_cast<T>(Table::row_size)));
  const Rows<D> primitive(d, rows, is_hit);
  const V t = hn::IfThenElseZero(is_hit, hit.t);
  // Made where it is returned: copies of so large a structure wait for what was just stored.
  Surface<D> surface{{mul_add(direction, t, from.point), hit.normal, hit.id, hit.u, hit.v},
                     primitive.followed(d, table.column(Table::material), is_hit)};
  RayOrigin<V>& at = surface.at;
  const auto value = [&](typename Table::Value column)
                         HWY_ATTR { return primitive(d, table.column(column)); };
  const V zero = hn::Zero(d);
  const V curvature = value(Table::curvature);
  M own = hn::Lt(t, t);
  if (scene.has_own_normals) own = hn::And(is_hit, hn::Lt(curvature, zero));
  const M others = hn::AndNot(own, is_hit);
  if (!hn::AllFalse(d, others)) {
    const V3<V> place{value(Table::x), value(Table::y), value(Table::z)};
    V3<V> normal = scale(sub(at.point, place), curvature);
    if (scene.has_flat) {
      const M flat = hn::Eq(curvature, zero);
      const M ahead = hn::Gt(dot(place, direction), zero);
      normal = select(flat, select(ahead, negate(place), place), normal);
    }
    at.normal = scene.has_own_normals ? select(others, normal, at.normal) : normal;
  }
  if (scene.has_own_normals && !hn::AllFalse(d, own))
    for_each_geometry(scene, [&](const auto& geometry) RAYTRACER_INLINE_ATTR {
      if constexpr (requires { own_normals(d, scene, geometry, direction, own, at); })
        own_normals(d, scene, geometry, direction, own, at);
    });
  return surface;
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
