// What a hit needs to be shaded: the place, the normal and the cell of a square.

#if defined(RAYTRACER_KERNEL_SIMD_SURFACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_SURFACE_INL_H_
#undef RAYTRACER_KERNEL_SIMD_SURFACE_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_SURFACE_INL_H_
#endif

#include "engine/kernel/simd/hit-inl.h"
#include "engine/kernel/simd/packet-inl.h"
#include "engine/kernel/simd/square-inl.h"

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
  Start<V> at;
  Rows<D> material;
};

/// The surfaces that the lanes of `hit` have met, at least one, where they met them.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE Surface<D> surface_at(D d, const SimdScene<T>& scene, const Start<V>& from,
                                 const V3<V>& direction, const Nearest<V>& nearest, M hit) {
  using Table = PrimitiveTable<T>;
  const Table& table = scene.primitives;
  const V rows = hn::Mul(nearest.id, hn::Set(d, static_cast<T>(Table::row_size)));
  const Rows<D> primitive(d, rows, hit);
  const V t = hn::IfThenElseZero(hit, nearest.t);
  // Made where it is returned: copies of so large a structure wait for what was just stored.
  Surface<D> surface{{mul_add(direction, t, from.point), nearest.normal, nearest.id, nearest.first,
                      nearest.second},
                     primitive.followed(d, table.column(Table::material), hit)};
  Start<V>& at = surface.at;
  M of_squares = hn::Lt(t, t);
  for (const SimdSquare<T>& square : scene.squares)
    of_squares = hn::Or(of_squares, hn::Eq(nearest.id, hn::Set(d, square.id)));
  const M others = hn::AndNot(of_squares, hit);
  if (!hn::AllFalse(d, others)) {
    const auto value = [&](typename Table::Value column)
                           HWY_ATTR { return primitive(d, table.column(column)); };
    const V curvature = value(Table::curvature);
    const V3<V> place{value(Table::x), value(Table::y), value(Table::z)};
    V3<V> normal = scale(sub(at.point, place), curvature);
    if (!scene.planes.empty() || scene.has_triangles) {
      const M flat = hn::Eq(curvature, hn::Zero(d));
      const M ahead = hn::Gt(dot(place, direction), hn::Zero(d));
      normal = select(flat, select(ahead, negate(place), place), normal);
    }
    at.normal = select(others, normal, at.normal);
  }
  return surface;
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
