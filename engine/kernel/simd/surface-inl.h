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

/// Each lane's row of a column of the surface table.
template <class D, class VI, typename T = hn::TFromD<D>>
HWY_INLINE hn::Vec<D> column(D d, const std::vector<T>& values, VI rows) {
  return hn::GatherIndex(d, values.data(), rows);
}

/// The surfaces that the lanes have met, where they met them.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE Start<V> surface_at(D d, const SimdScene<T>& scene, const Start<V>& from,
                               const V3<V>& direction, const Nearest<V>& nearest) {
  const hn::RebindToSigned<D> di;
  const SurfaceTable<T>& table = scene.surfaces;
  const V zero = hn::Zero(d);
  const auto hit = hn::Ge(nearest.id, zero);
  const auto rows = hn::ConvertTo(di, hn::IfThenElseZero(hit, nearest.id));
  const V t = hn::IfThenElseZero(hit, nearest.t);

  Start<V> surface{
      mul_add(direction, t, from.point), {}, nearest.id, nearest.first, nearest.second};
  const V curvature = column(d, table.curvature, rows);
  const V3<V> place{column(d, table.x, rows), column(d, table.y, rows), column(d, table.z, rows)};
  surface.normal = scale(sub(surface.point, place), curvature);
  if (!scene.planes.empty() || !scene.triangles.empty()) {
    const auto flat = hn::Eq(curvature, zero);
    const auto ahead = hn::Gt(dot(place, direction), zero);
    surface.normal = select(flat, select(ahead, negate(place), place), surface.normal);
  }

  for (const SimdSquare<T>& square : scene.squares) {
    const auto of_square = hn::Eq(nearest.id, hn::Set(d, static_cast<T>(square.id)));
    if (hn::AllFalse(d, of_square)) continue;
    const V to_cells = hn::Set(d, square.cells_per_unit);
    const V3<V> in_cells =
        mul_add(along_square(square, surface.point), to_cells, broadcast(d, square.eye));
    const V3<V> from_center{hn::Sub(in_cells.x, nearest.first), in_cells.y,
                            hn::Sub(in_cells.z, nearest.second)};
    surface.normal = select(of_square, from_square(square, unit(d, from_center)), surface.normal);
  }
  return surface;
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
