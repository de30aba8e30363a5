// What a packet of rays meets first, and whether light reaches it: everything together.

#if defined(RAYTRACER_KERNEL_SIMD_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_RAYS_INL_H_
#undef RAYTRACER_KERNEL_SIMD_RAYS_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_RAYS_INL_H_
#endif

#include <limits>

#include "engine/kernel/simd/grid-inl.h"
#include "engine/kernel/simd/square-inl.h"
#include "engine/kernel/simd/tree-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// The packet against everything but spheres on their own.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void show_squares_and_planes(D d, const SimdScene<T>& scene, const Start<V>& from,
                                        const V3<V>& direction, M active, Nearest<V>& nearest) {
  for (const SimdPlane<T>& plane : scene.planes) {
    V t;
    const M hit = hn::And(active, meets_plane(d, plane, from, direction, t));
    const V id = hn::Set(d, static_cast<T>(plane.id));
    take(nearest, is_nearer(nearest, t, id, hit), t, id);
  }
  for (const SimdSquare<T>& square : scene.squares) {
    const V to_cells = hn::Set(d, square.cells_per_unit);
    const V3<V> origin =
        mul_add(along_square(square, from.point), to_cells, broadcast(d, square.eye));
    const V id = hn::Set(d, static_cast<T>(square.id));
    const M leaves = hn::Eq(from.id, id);
    const V nowhere = hn::Set(d, std::numeric_limits<T>::max());
    const CellHit<V, M> found = walk_square(
        d, square, origin, along_square(square, direction), hn::Mul(nearest.t, to_cells), active,
        hn::IfThenElse(leaves, from.first, nowhere), hn::IfThenElse(leaves, from.second, nowhere));
    const V t = hn::Mul(found.t, hn::Set(d, square.unit_per_cell));
    const M nearer = is_nearer(nearest, t, id, found.hit);
    take(nearest, nearer, t, id);
    nearest.first = hn::IfThenElse(nearer, found.first, nearest.first);
    nearest.second = hn::IfThenElse(nearer, found.second, nearest.second);
  }
}

/// Lanes of `lit` from which something stands before the light, nearer than `distance`.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded(D d, const SimdScene<T>& scene, const SimdLight<T>& light,
                      const Start<V>& from, const V3<V>& towards, V distance, M lit) {
  M dark = hn::Lt(hn::Zero(d), hn::Zero(d));
  if (scene.has_light_grids) dark = occluded_in_grid(d, light.grid, from, lit);
  const bool has_tree = !scene.tree.nodes.empty();
  if (has_tree && (!scene.triangles.empty() || !scene.has_light_grids)) {
    dark = hn::Or(
        dark, occluded_in_tree(d, scene, light, from, towards, distance, hn::AndNot(dark, lit)));
  } else if (!has_tree && !scene.has_light_grids) {
    for (const SimdSphere<T>& sphere : scene.spheres)
      dark = hn::Or(dark, occluded_by(d, sphere, light, from, towards, distance, lit));
  }
  for (const SimdPlane<T>& plane : scene.planes) {
    V t;
    const M hit = meets_plane(d, plane, from, towards, t);
    dark = hn::Or(dark, hn::And(hn::And(lit, hit), hn::Lt(t, distance)));
  }
  for (std::size_t i = 0; i < scene.squares.size(); ++i) {
    const SimdSquare<T>& square = scene.squares[i];
    const Stencil<T>& stencil = light.stencils[i];
    const V3<V> along = along_square(square, towards);
    const M leaves = hn::Eq(from.id, hn::Set(d, static_cast<T>(square.id)));
    M rest = hn::AndNot(dark, lit);
    if (stencil.suffices) {
      const M neighbours = hn::And(rest, leaves);
      if (!hn::AllFalse(d, neighbours))
        dark = hn::Or(dark,
                      shadowed_by_neighbours(d, square, stencil, from.first, from.second,
                                             along_square(square, from.normal), along, neighbours));
      rest = hn::AndNot(leaves, rest);
    }
    if (hn::AllFalse(d, rest)) continue;
    const V to_cells = hn::Set(d, square.cells_per_unit);
    const V3<V> origin =
        mul_add(along_square(square, from.point), to_cells, broadcast(d, square.eye));
    const V nowhere = hn::Set(d, std::numeric_limits<T>::max());
    const CellHit<V, M> found = walk_square(d, square, origin, along, hn::Mul(distance, to_cells),
                                            rest, hn::IfThenElse(leaves, from.first, nowhere),
                                            hn::IfThenElse(leaves, from.second, nowhere));
    const M before = hn::Lt(found.t, hn::Mul(distance, to_cells));
    dark = hn::Or(dark, hn::And(found.hit, before));
  }
  return dark;
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
