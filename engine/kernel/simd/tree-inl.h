// Packets through a tree of boxes: the lanes go together, into every node that one of them enters.
//
// For rays that share neither origin nor direction, and for triangles. Boxes are rounded outward
// when they are narrowed, and entered a little generously, so that no primitive is lost to the
// rounding of a box.

#if defined(RAYTRACER_KERNEL_SIMD_TREE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYTRACER_KERNEL_SIMD_TREE_INL_H_
#undef RAYTRACER_KERNEL_SIMD_TREE_INL_H_
#else
#define RAYTRACER_KERNEL_SIMD_TREE_INL_H_
#endif

#include <limits>

#include "engine/kernel/simd/flat-inl.h"
#include "engine/kernel/simd/sphere-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer {
namespace HWY_NAMESPACE {

/// Rays prepared for boxes.
template <class V>
struct BoxPacket {
  V3<V> origin;
  V3<V> inverse;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE BoxPacket<V> box_packet(D d, const V3<V>& origin, const V3<V>& direction) {
  const V one = hn::Set(d, hn::TFromD<D>(1));
  const auto inverse = [&](V slope) HWY_ATTR { return hn::Div(one, without_zero(d, slope)); };
  return {origin, {inverse(direction.x), inverse(direction.y), inverse(direction.z)}};
}

/// The lanes that enter the box before t_max, and where.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M enters(D d, const BoxPacket<V>& rays, const SimdNode<T>& node, V t_max, V& t_begin) {
  const auto along = [&](T place, V origin, V inverse)
                         HWY_ATTR { return hn::Mul(hn::Sub(hn::Set(d, place), origin), inverse); };
  const V x1 = along(node.low.x, rays.origin.x, rays.inverse.x);
  const V x2 = along(node.high.x, rays.origin.x, rays.inverse.x);
  const V y1 = along(node.low.y, rays.origin.y, rays.inverse.y);
  const V y2 = along(node.high.y, rays.origin.y, rays.inverse.y);
  const V z1 = along(node.low.z, rays.origin.z, rays.inverse.z);
  const V z2 = along(node.high.z, rays.origin.z, rays.inverse.z);
  t_begin =
      hn::Max(hn::Max(hn::Min(x1, x2), hn::Min(y1, y2)), hn::Max(hn::Min(z1, z2), hn::Zero(d)));
  const V t_end = hn::Min(hn::Min(hn::Max(x1, x2), hn::Max(y1, y2)), hn::Max(z1, z2));
  const V generous = hn::Set(d, T(1) + 8 * std::numeric_limits<T>::epsilon());
  return hn::Le(t_begin, hn::Min(hn::Mul(t_end, generous), t_max));
}

/// Calls leaf(begin, end) with ranges of the tree's order for every leaf that a lane may need,
/// near ones first. `t_max` is read again before each node, so a leaf may lower it; is_settled()
/// ends the walk.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>,
          class Leaf, class IsSettled>
HWY_INLINE void walk_tree(D d, const SimdTree<T>& tree, const V3<V>& origin, const V3<V>& direction,
                          M active, const V& t_max, const Leaf& leaf, const IsSettled& is_settled) {
  if (tree.nodes.empty()) return;
  const BoxPacket<V> rays = box_packet(d, origin, direction);
  std::uint32_t stack[deepest_tree + 1];
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const SimdNode<T>& node = tree.nodes[stack[--size]];
    V t_node;
    // Asked when taken from the stack, because t_max may have fallen since it was put there.
    if (hn::AllFalse(d, hn::And(active, enters(d, rays, node, t_max, t_node)))) continue;
    if (node.count > 0) {
      leaf(node.first, node.first + node.count);
      if (is_settled()) return;
      continue;
    }
    // The child that lies first along the packet's direction goes on top.
    const T slope = node.axis == 0   ? hn::GetLane(direction.x)
                    : node.axis == 1 ? hn::GetLane(direction.y)
                                     : hn::GetLane(direction.z);
    const bool forward = slope >= 0;
    stack[size++] = forward ? node.first + 1 : node.first;
    stack[size++] = forward ? node.first : node.first + 1;
  }
}

/// The packet against the tree's triangles, and its spheres too unless those are found otherwise.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE void show_tree(D d, const SimdScene<T>& scene, const Start<V>& from,
                          const V3<V>& direction, M active, bool with_spheres,
                          Nearest<V>& nearest) {
  const auto sphere_count = static_cast<std::uint32_t>(scene.spheres.size());
  const AcrossPacket<V> plane = across_packet(d, direction);
  walk_tree(
      d, scene.tree, from.point, direction, active, nearest.t,
      [&](std::uint32_t begin, std::uint32_t end) HWY_ATTR {
        for (std::uint32_t i = begin; i < end; ++i) {
          const std::uint32_t primitive = scene.tree.order[i];
          if (primitive >= sphere_count) {
            const SimdTriangle<T>& triangle = scene.triangles[primitive - sphere_count];
            V t;
            const M hit = meets_triangle(d, triangle, from, direction, plane, active, t);
            const V id = hn::Set(d, static_cast<T>(triangle.plane.id));
            take(nearest, is_nearer(nearest, t, id, hit), t, id);
          } else if (with_spheres) {
            show_sphere(d, scene.spheres[primitive], from, direction, active, nearest);
          }
        }
      },
      []() HWY_ATTR { return false; });
}

/// Lanes of `lit` from which something in the tree stands before the light.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M occluded_in_tree(D d, const SimdScene<T>& scene, const SimdLight<T>& light,
                              const Start<V>& from, const V3<V>& towards, V distance, M lit) {
  const auto sphere_count = static_cast<std::uint32_t>(scene.spheres.size());
  const bool with_spheres = !scene.has_light_grids;
  M dark = hn::Lt(distance, hn::Zero(d));
  const AcrossPacket<V> plane = across_packet(d, towards);
  walk_tree(
      d, scene.tree, from.point, towards, lit, distance,
      [&](std::uint32_t begin, std::uint32_t end) HWY_ATTR {
        for (std::uint32_t i = begin; i < end; ++i) {
          const std::uint32_t primitive = scene.tree.order[i];
          if (primitive >= sphere_count) {
            V t;
            const M hit = meets_triangle(d, scene.triangles[primitive - sphere_count], from,
                                         towards, plane, lit, t);
            dark = hn::Or(dark, hn::And(hit, hn::Lt(t, distance)));
          } else if (with_spheres) {
            dark = hn::Or(dark, occluded_by(d, scene.spheres[primitive], light, from, towards,
                                            distance, lit));
          }
        }
      },
      [&]() HWY_ATTR { return hn::AllTrue(d, hn::Or(dark, hn::Not(lit))); });
  return dark;
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
