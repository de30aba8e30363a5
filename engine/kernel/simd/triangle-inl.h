// Triangles found by 2-D structures: by the screen's bins, which share the eye, and by a distant
// light's grid, whose rays share a direction.
//
// Sides are tested by what is known beforehand: the plane through the eye and a side, or its line
// as the light sees it. Two triangles that share a side have opposite ones, to the bit, and all are
// a few roundings generous, so that no ray slips between triangles at a side or a corner.

#if defined(RAYTRACER_KERNEL_SIMD_TRIANGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_TRIANGLE_INL_H_
#undef RAYTRACER_KERNEL_SIMD_TRIANGLE_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_TRIANGLE_INL_H_
#endif

#include <array>
#include <cstddef>
#include <limits>

#include "engine/kernel/simd/cells-inl.h"
#include "engine/kernel/simd/flat-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// Rays from the eye against the triangles of what they go through: near to far, until the next one
/// is farther than all that is seen already.
template <class D, class Contents, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE void show_triangles_to_eye(D d, const SimdScene<T>& scene, const Contents& contents,
                                      const V3<V>& direction, M active, Nearest<V>& nearest) {
  const V zero = hn::Zero(d);
  const V outside = hn::Set(d, -4 * std::numeric_limits<T>::epsilon());
  const auto sees = [&](float distance)
                        HWY_ATTR { return sees_as_far_as(d, distance, nearest, active); };
  contents.for_each_triangle(sees, [&](std::uint32_t primitive) HWY_ATTR {
    const TriangleCone<T>& cone = scene.eye_cones[primitive];
    const V least = hn::Min(
        hn::Min(dot(broadcast(d, cone[0]), direction), dot(broadcast(d, cone[1]), direction)),
        dot(broadcast(d, cone[2]), direction));
    const M inside = hn::Ge(least, outside);
    if (hn::AllFalse(d, inside)) return;
    const SimdPlane<T>& plane = scene.triangles[primitive].plane;
    const V t = hn::Div(hn::Set(d, plane.height), dot(broadcast(d, plane.normal), direction));
    const M ahead = hn::And(hn::Gt(t, zero), hn::Lt(t, hn::Set(d, std::numeric_limits<T>::max())));
    const V id = hn::Set(d, static_cast<T>(plane.id));
    take(nearest, is_nearer(nearest, t, id, hn::And(inside, ahead)), t, id);
  });
}

/// A triangle in all lanes.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE Triangles<V> in_all_lanes(D d, const SimdTriangle<T>& triangle) {
  return {broadcast(d, triangle.corners[0]), broadcast(d, triangle.corners[1]),
          broadcast(d, triangle.corners[2]), broadcast(d, triangle.plane.normal),
          hn::Set(d, triangle.plane.height), hn::Set(d, static_cast<T>(triangle.plane.id))};
}

/// Lanes of `rest`, all in one cell of the grid, before which one of the cell's triangles stands.
/// `u` and `v` are the lanes' places on the grid, `least_w` is how near to the light the farthest
/// of them is.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_in_cell(D d, const SimdScene<T>& scene, const TriangleGrid<T>& grid,
                              std::size_t cell, const Start<V>& from, const V3<V>& towards, V u,
                              V v, T least_w, M rest) {
  const V outside = hn::Set(d, -grid.noise);
  M dark = hn::Lt(hn::Zero(d), hn::Zero(d));
  for (std::size_t i = grid.begins[cell]; i < grid.begins[cell + 1]; ++i) {
    const GridTriangle<T>& entry = grid.entries[i];
    if (entry.top <= least_w) break;  // this one and all behind it are farther from the light
    const TriangleOutline<T>& outline = grid.outlines[entry.triangle];
    const auto side = [&](std::size_t k) HWY_ATTR {
      return hn::MulAdd(
          hn::Set(d, outline.u_slopes[k]), u,
          hn::MulAdd(hn::Set(d, outline.v_slopes[k]), v, hn::Set(d, outline.offsets[k])));
    };
    const M covers = hn::And(rest, hn::Ge(hn::Min(hn::Min(side(0), side(1)), side(2)), outside));
    if (hn::AllFalse(d, covers)) continue;
    const SimdTriangle<T>& triangle = scene.triangles[entry.triangle];
    V t;
    M hit = hn::And(covers, meets_plane(d, triangle.plane, from, towards, t));
    if (hn::AllFalse(d, hit)) continue;
    hit = hn::And(hit, rises_above(d, in_all_lanes(d, triangle), from));
    dark = hn::Or(dark, hit);
    rest = hn::AndNot(hit, rest);
    if (hn::AllFalse(d, rest)) break;
  }
  return dark;
}

/// Lanes of `lit` from which a triangle of the grid stands before its distant light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_by_triangles(D d, const SimdScene<T>& scene, const TriangleGrid<T>& grid,
                                   const Start<V>& from, const V3<V>& towards, M lit) {
  const GridPlaces<V, M> at = places_on(d, grid, from.point);
  M rest = hn::And(lit, at.is_on_grid);  // off the grid nothing stands before the light
  M dark = hn::Lt(at.u, at.u);
  alignas(64) T columns[hn::MaxLanes(D())];
  alignas(64) T rows[hn::MaxLanes(D())];
  hn::Store(at.column, d, columns);
  hn::Store(at.row, d, rows);
  const V highest = hn::Set(d, std::numeric_limits<T>::max());
  while (!hn::AllFalse(d, rest)) {
    // All lanes in the first one's cell.
    const auto first = static_cast<std::size_t>(hn::FindFirstTrue(d, rest));
    const M here = hn::And(rest, hn::And(hn::Eq(at.column, hn::Set(d, columns[first])),
                                         hn::Eq(at.row, hn::Set(d, rows[first]))));
    const T least_w = hn::GetLane(hn::MinOfLanes(d, hn::IfThenElse(here, at.w, highest)));
    const std::size_t cell =
        static_cast<std::size_t>(rows[first]) * static_cast<std::size_t>(grid.columns) +
        static_cast<std::size_t>(columns[first]);
    dark = hn::Or(dark,
                  occluded_in_cell(d, scene, grid, cell, from, towards, at.u, at.v, least_w, here));
    rest = hn::AndNot(here, rest);
  }
  return dark;
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
