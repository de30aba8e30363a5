// What a packet of rays meets first, and whether light reaches it: everything together.

#if defined(RAYTRACER_KERNEL_SIMD_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_RAYS_INL_H_
#undef RAYTRACER_KERNEL_SIMD_RAYS_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_RAYS_INL_H_
#endif

#include <limits>

#include "engine/kernel/simd/grid-inl.h"
#include "engine/kernel/simd/point_grid-inl.h"
#include "engine/kernel/simd/square-inl.h"
#include "engine/kernel/simd/tree-inl.h"
#include "engine/kernel/simd/triangle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// A triangle or a square that a ray meets nearer than this share of a point light's distance hides
/// the light: one that lies in a surface is not hidden by that.
template <typename T>
inline constexpr T nearer_than_light = 1 - 4096 * std::numeric_limits<T>::epsilon();

/// The packet against the planes.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void show_planes(D d, const SimdScene<T>& scene, const Start<V>& from,
                            const V3<V>& direction, M active, Nearest<V>& nearest) {
  for (const SimdPlane<T>& plane : scene.planes) {
    V t;
    const M hit = hn::And(active, meets_plane(d, plane, from, direction, t));
    const V id = hn::Set(d, static_cast<T>(plane.id));
    take(nearest, is_nearer(nearest, t, id, hit), t, id);
  }
}

/// Asks the memory for what occluded() will need of distant lights' grids for the points of
/// `lanes`. Cells around point lights are not worth it: 400,000 spheres took 1.04 of the time.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void fetch_light_cells(D d, const SimdScene<T>& scene, const V3<V>& points, M lanes) {
  for (const SimdLight<T>& light : scene.lights)
    if (light.is_distant) fetch_grid_cells(d, light.grid, points, lanes);
}

/// Lanes of `lit` from which something stands before the light. `path` is their distance from a
/// point light, for a distant one the largest number; `incidence` is normal . towards.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded(D d, const SimdScene<T>& scene, const SimdLight<T>& light,
                      const Start<V>& from, const V3<V>& towards, V path, V incidence, M lit) {
  const V distance = hn::Mul(path, hn::Set(d, nearer_than_light<T>));
  M dark = hn::Lt(hn::Zero(d), hn::Zero(d));
  if (scene.has_light_grids)
    dark = light.is_distant
               ? occluded_in_grid(d, light.grid, from, lit)
               : occluded_in_point_grid(d, light.point_grid, light.place, from, towards, lit);
  else if (!light.is_distant)
    for (const LightBall<T>& ball : light.balls)
      dark = hn::Or(dark, occluded_by(d, ball, light.is_far, from, towards, path, lit));
  else if (!scene.sphere_tree.is_empty())
    dark = occluded_in_tree(d, scene.sphere_tree, from, towards, distance, lit);
  else
    for (const SimdSphere<T>& sphere : scene.spheres)
      dark = hn::Or(dark, occluded_by(d, sphere, from, towards, lit));
  if (!light.triangle_grid.outlines.empty()) {
    dark = hn::Or(dark, occluded_by_triangles(d, scene, light.triangle_grid, from, towards,
                                              hn::AndNot(dark, lit)));
  } else if (!scene.triangle_tree.is_empty()) {
    const M rest = hn::AndNot(dark, lit);
    dark = hn::Or(dark, occluded_in_tree(d, scene.triangle_tree, from, towards, distance, rest));
  }
  for (std::size_t i = 0; i < scene.planes.size(); ++i) {
    V t;
    const M hides = light.is_distant
                        ? meets_plane(d, scene.planes[i], from, towards, t)
                        : stands_between(d, scene.planes[i], from, light.plane_sides[i]);
    dark = hn::Or(dark, hn::And(lit, hides));
  }
  for (std::size_t i = 0; i < scene.squares.size(); ++i)
    dark = hn::Or(dark, occluded_by_square(d, scene.squares[i], light.stencils[i], from, towards,
                                           distance, incidence, hn::AndNot(dark, lit)));
  return dark;
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
