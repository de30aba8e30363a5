// Rays through a tree of boxes: the lanes of a packet together, into every node that one of them
// enters, or each on its own, against all boxes of a node at once (Wald, Benthin, Boulos: "Getting
// Rid of Packets", 2008).
//
// For rays that share neither origin nor direction. Boxes are rounded outward when they are
// built, and entered a little generously, so that no primitive is lost to the rounding of a box
// (Ize: "Robust BVH Ray Traversal", JCGT 2013).

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "engine/finders/primitive_tree.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// For the primitives of a leaf.
template <typename T>
using EightTag = hn::CappedTag<T, TreeNode::width>;

/// Rays prepared for a tree: one to a lane, or the same in all lanes.
template <class V, class Origin = RayOrigin<V>>
struct TreeRays {
  Origin from;
  V3<V> direction;
  V3<V> inverse;  ///< 1 / direction, finite
  BasisPacket<V> basis;
};

template <class D, class Origin, class V = hn::Vec<D>>
HWY_INLINE TreeRays<V, Origin> tree_rays(D d, const Origin& from, const V3<V>& direction) {
  const V one = hn::Set(d, hn::TFromD<D>(1));
  const auto inverse = [&](V slope) HWY_ATTR { return hn::Div(one, without_zero(d, slope)); };
  return {from,
          direction,
          {inverse(direction.x), inverse(direction.y), inverse(direction.z)},
          basis_across(d, direction)};
}

/// A child that is still to be tried, and the least distance at which it may be met.
struct UntriedChild {
  TreeChild child;
  float t;
};

/// The same of a packet, and a bit for each lane that enters it.
template <typename T>
struct UntriedByLanes {
  TreeChild child;
  T t;
  std::uint32_t lanes;
};

/// Untried children; of a node's the nearest is on top.
template <class Entry>
struct TreeStack {
  Entry entries[Tree::stack_size];
  std::size_t size = 0;

  explicit TreeStack(const Entry& root) { push(root, 0); }

  /// Below the entries from `first` on that are nearer.
  HWY_INLINE void push(const Entry& entry, std::size_t first) {
    std::size_t place = size++;
    for (; place > first && entries[place - 1].t < entry.t; --place)
      entries[place] = entries[place - 1];
    entries[place] = entry;
  }
  HWY_INLINE Entry pop() { return entries[--size]; }
};

template <typename T>
inline constexpr T generous = 1 + 8 * std::numeric_limits<T>::epsilon();

/// For all boxes of a node, or as many as fit.
using NodeTag = hn::CappedTag<float, TreeNode::width>;
using NodeVec = hn::Vec<NodeTag>;

/// One ray for the boxes of nodes, the same in all lanes: in single precision whatever its own.
/// What narrowing has moved its origin by makes boxes that much larger.
struct NodeRay {
  V3<NodeVec> near_from;  ///< for the sides where it may come in
  V3<NodeVec> far_from;   ///< and for those where it may go out
  V3<NodeVec> inverse;
  bool backwards[3];
};

/// By what share of its place, more than enough.
inline constexpr float narrowing_slack = 4 * std::numeric_limits<float>::epsilon();

template <typename T>
HWY_INLINE NodeRay node_ray_of(const Triple<T>& from, const Triple<T>& inverse) {
  const NodeTag d;
  const auto moved = [&](T place, T slope, float share) HWY_ATTR {
    const auto narrowed = static_cast<float>(place);
    if constexpr (sizeof(T) == sizeof(float)) return hn::Set(d, narrowed);
    return hn::Set(d, narrowed + (slope < 0 ? -share : share) * std::abs(narrowed));
  };
  const auto all = [&](float share) HWY_ATTR {
    return V3<NodeVec>{moved(from.x, inverse.x, share), moved(from.y, inverse.y, share),
                       moved(from.z, inverse.z, share)};
  };
  return {all(narrowing_slack),
          all(-narrowing_slack),
          {hn::Set(d, static_cast<float>(inverse.x)), hn::Set(d, static_cast<float>(inverse.y)),
           hn::Set(d, static_cast<float>(inverse.z))},
          {inverse.x < 0, inverse.y < 0, inverse.z < 0}};
}

/// How far boxes have to be looked at for something nearer than t_max.
template <typename T>
HWY_INLINE float box_reach(T t_max) {
  if constexpr (sizeof(T) == sizeof(float)) return t_max;
  constexpr T most = std::numeric_limits<float>::max();
  return static_cast<float>(std::min(t_max * generous<float>, most));
}

/// One ray against all boxes of a node: a bit for each that it enters within `reach`, and where.
HWY_INLINE std::uint32_t enters(const NodeRay& ray, const TreeNode& node, float reach,
                                float* t_begins) {
  const NodeTag d;
  std::uint32_t entered = 0;
  for (std::size_t i = 0; i < TreeNode::width; i += hn::Lanes(d)) {
    const auto along = [&](std::size_t axis, bool is_far, NodeVec from, NodeVec inverse) HWY_ATTR {
      const auto& side = ray.backwards[axis] != is_far ? node.high[axis] : node.low[axis];
      return hn::Mul(hn::Sub(hn::LoadU(d, side.data() + i), from), inverse);
    };
    const NodeVec t_begin =
        hn::Max(hn::Max(along(0, false, ray.near_from.x, ray.inverse.x),
                        along(1, false, ray.near_from.y, ray.inverse.y)),
                hn::Max(along(2, false, ray.near_from.z, ray.inverse.z), hn::Zero(d)));
    const NodeVec t_end = hn::Min(hn::Min(along(0, true, ray.far_from.x, ray.inverse.x),
                                          along(1, true, ray.far_from.y, ray.inverse.y)),
                                  along(2, true, ray.far_from.z, ray.inverse.z));
    hn::Store(t_begin, d, t_begins + i);
    const auto enter =
        hn::Le(t_begin, hn::Min(hn::Mul(t_end, hn::Set(d, generous<float>)), hn::Set(d, reach)));
    entered |= static_cast<std::uint32_t>(bits_of(d, enter)) << i;
  }
  return entered;
}

/// Takes one ray to the leaves that it may need, near ones first, until leaf(block) says that it is
/// settled. `t_max` is read again, so a leaf may lower it.
template <class Block, typename T, class Leaf>
HWY_INLINE void walk_alone(const PacketTree<Block>& tree, const NodeRay& ray, const T& t_max,
                           const Leaf& leaf) {
  TreeStack<UntriedChild> stack({TreeChild::node(0), 0});
  while (stack.size > 0) {
    const UntriedChild entry = stack.pop();
    const float reach = box_reach(t_max);
    if (entry.t > reach) continue;
    if (entry.child.is_leaf()) {
      if (leaf(tree.leaves[entry.child.index()])) return;
      continue;
    }
    const TreeNode& node = tree.nodes[entry.child.index()];
    alignas(64) float t_begins[TreeNode::width];
    std::uint32_t entered = enters(ray, node, reach, t_begins);
    const std::size_t first = stack.size;
    for (; entered != 0; entered &= entered - 1) {
      const auto i = static_cast<std::size_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(entered));
      stack.push({node.children[i], t_begins[i]}, first);
    }
  }
}

/// The lanes that enter the box before t_max.
template <class D, class Origin, class V = hn::Vec<D>, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>>
HWY_INLINE M enters_child(D d, const TreeRays<V, Origin>& rays, const TreeNode& node,
                          std::size_t child, V t_max, V& t_begin) {
  const auto along = [&](float place, V origin, V inverse) HWY_ATTR {
    return hn::Mul(hn::Sub(hn::Set(d, static_cast<T>(place)), origin), inverse);
  };
  const V3<V>& origin = rays.from.point;
  const V x1 = along(node.low[0][child], origin.x, rays.inverse.x);
  const V x2 = along(node.high[0][child], origin.x, rays.inverse.x);
  const V y1 = along(node.low[1][child], origin.y, rays.inverse.y);
  const V y2 = along(node.high[1][child], origin.y, rays.inverse.y);
  const V z1 = along(node.low[2][child], origin.z, rays.inverse.z);
  const V z2 = along(node.high[2][child], origin.z, rays.inverse.z);
  t_begin =
      hn::Max(hn::Max(hn::Min(x1, x2), hn::Min(y1, y2)), hn::Max(hn::Min(z1, z2), hn::Zero(d)));
  const V t_end = hn::Min(hn::Min(hn::Max(x1, x2), hn::Max(y1, y2)), hn::Max(z1, z2));
  return hn::Le(t_begin, hn::Min(hn::Mul(t_end, hn::Set(d, generous<T>)), t_max));
}

/// Takes a packet to the leaves that a lane of `active` may need, near ones first, until
/// leaf(block, lanes) says that all is settled; these are the lanes that enter it. `active` and
/// `t_max` are read again, so a leaf may lower them.
template <class D, class V, class Origin, class M, class Block, typename T = hn::TFromD<D>,
          class Leaf>
HWY_INLINE void walk_together(D d, const PacketTree<Block>& tree, const TreeRays<V, Origin>& rays,
                              const M& active, const V& t_max, const Leaf& leaf) {
  const V far_away = hn::Set(d, std::numeric_limits<T>::max());
  const auto bits = [&](M mask) HWY_ATTR { return static_cast<std::uint32_t>(bits_of(d, mask)); };
  TreeStack<UntriedByLanes<T>> stack({TreeChild::node(0), 0, bits(active)});
  while (stack.size > 0) {
    const auto entry = stack.pop();
    const M in_reach = hn::And(active, hn::Le(hn::Set(d, entry.t), t_max));
    const std::uint32_t left = entry.lanes & bits(in_reach);
    if (left == 0) continue;
    const M rest = mask_of(d, left);
    if (entry.child.is_leaf()) {
      if (leaf(tree.leaves[entry.child.index()], rest)) return;
      continue;
    }
    const TreeNode& node = tree.nodes[entry.child.index()];
    const std::size_t first = stack.size;
    for (std::size_t i = 0; i < node.child_count; ++i) {
      V t_begin;
      const M entered = hn::And(rest, enters_child(d, rays, node, i, t_max, t_begin));
      const std::uint32_t lanes = bits(entered);
      if (lanes == 0) continue;
      const T t = hn::GetLane(hn::MinOfLanes(d, hn::IfThenElse(entered, t_begin, far_away)));
      stack.push({node.children[i], t, lanes}, first);
    }
  }
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
