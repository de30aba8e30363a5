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

#include "engine/kernel/simd/packet-inl.h"
#include "engine/kernel/simd/simd_scene.h"

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

/// The lanes' planes across their rays (see across() in engine/math/vec.h).
template <class V>
struct AcrossPacket {
  V3<V> u;
  V3<V> v;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE AcrossPacket<V> across_packet(D d, const V3<V>& w) {
  const V one = hn::Set(d, hn::TFromD<D>(1));
  const V sign = hn::CopySign(one, w.z);
  const V a = hn::Neg(hn::Div(one, hn::Add(sign, w.z)));
  const V b = hn::Mul(hn::Mul(w.x, w.y), a);
  return {{hn::MulAdd(hn::Mul(sign, w.x), hn::Mul(w.x, a), one), hn::Mul(sign, b),
           hn::Neg(hn::Mul(sign, w.x))},
          {b, hn::MulAdd(hn::Mul(w.y, w.y), a, sign), hn::Neg(w.y)}};
}

/// Lanes whose rays pass through the triangle, as intersect_triangle() in engine/kernel/flat.h
/// decides it. The products are not fused: that could make their difference's sign wrong.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE M passes_through(D d, const SimdTriangle<T>& triangle, const V3<V>& origin,
                            const AcrossPacket<V>& plane) {
  const V3<V> a = sub(broadcast(d, triangle.a), origin);
  const V3<V> b = sub(broadcast(d, triangle.b), origin);
  const V3<V> c = sub(broadcast(d, triangle.c), origin);
  const V a_u = dot(plane.u, a);
  const V a_v = dot(plane.v, a);
  const V b_u = dot(plane.u, b);
  const V b_v = dot(plane.v, b);
  const V c_u = dot(plane.u, c);
  const V c_v = dot(plane.v, c);
  const V ab = hn::Sub(hn::Mul(a_u, b_v), hn::Mul(a_v, b_u));
  const V bc = hn::Sub(hn::Mul(b_u, c_v), hn::Mul(b_v, c_u));
  const V ca = hn::Sub(hn::Mul(c_u, a_v), hn::Mul(c_v, a_u));
  const V least = hn::Min(hn::Min(ab, bc), ca);
  const V most = hn::Max(hn::Max(ab, bc), ca);
  const V zero = hn::Zero(d);
  return hn::Or(hn::Ge(least, zero), hn::Le(most, zero));
}

}  // namespace HWY_NAMESPACE
}  // namespace raytracer
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target
