// The shaft between the points of a packet and a light: what may hide any of the light from any of
// them is found once for all places on it (E. Haines, J. Wallace, Shaft Culling for Efficient
// Ray-Traced Radiosity, 1991).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// The hull of a ball around points and one around a light, and a box around both.
template <typename T>
struct Shaft {
  Triple<T> from;  ///< the middle of the points
  Triple<T> axis;  ///< unit, from there to the light's middle
  T length;
  T radius;  ///< at `from`, enlarged by what T rounds
  T growth;  ///< of the radius with the distance from there
  T slant;   ///< of the hull: how much farther it is from the axis than across it
  std::array<T, 3> low;
  std::array<T, 3> high;

  HWY_INLINE Shaft(const PointBox<T>& points, const Triple<T>& light, T light_radius)
      : from(points.middle) {
    const T x = light.x - from.x;
    const T y = light.y - from.y;
    const T z = light.z - from.z;
    length = std::sqrt(x * x + y * y + z * z);
    axis = length > 0 ? Triple<T>{x / length, y / length, z / length} : Triple<T>{0, 0, 1};
    const Triple<T>& half = points.half;
    const T size = std::abs(from.x) + std::abs(from.y) + std::abs(from.z);
    const T noise = 64 * std::numeric_limits<T>::epsilon() * (size + length + light_radius);
    radius = std::sqrt(half.x * half.x + half.y * half.y + half.z * half.z) + noise;
    // The hull widens evenly, unless one ball is all but inside the other; then it is within what
    // is everywhere as wide as the larger one.
    constexpr T steepest = T(0.9);
    growth = length > 0 ? (light_radius + noise - radius) / length : 1;
    if (!(std::abs(growth) < steepest)) {
      growth = 0;
      radius = std::max(radius, light_radius + noise);
    }
    slant = 1 / std::sqrt(1 - growth * growth);
    const T ends[3][3] = {
        {from.x, half.x, light.x}, {from.y, half.y, light.y}, {from.z, half.z, light.z}};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& [middle, reach, lamp] = ends[i];
      low[i] = std::min(middle - reach, lamp - light_radius) - noise;
      high[i] = std::max(middle + reach, lamp + light_radius) + noise;
    }
  }

  /// The lanes whose balls it may touch.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE hn::Mask<D> may_touch(D d, const V3<V>& center, V ball_radius) const {
    const V3<V> f = sub(center, broadcast(d, from));
    const V3<V> along = broadcast(d, axis);
    const V s = dot(f, along);
    const V3<V> across = mul_add(along, hn::Neg(s), f);
    // As wide as it is where the ball's ends are.
    const V wide =
        hn::MulAdd(hn::Set(d, growth), s,
                   hn::MulAdd(hn::Set(d, std::abs(growth)), ball_radius, hn::Set(d, radius)));
    const V reach = hn::MulAdd(hn::Set(d, slant), hn::Max(wide, hn::Zero(d)), ball_radius);
    return hn::Le(dot(across, across), hn::Mul(reach, reach));
  }
};

/// The sides of boxes, which are singles.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE hn::Vec<D> load_bounds(D d, const float* values) {
  if constexpr (sizeof(T) == sizeof(float))
    return hn::LoadU(d, values);
  else
    return hn::PromoteTo(d, hn::LoadU(hn::Rebind<float, D>(), values));
}

/// Takes a shaft to the leaves of a tree that it may touch, until leaf(index) says that it has seen
/// enough.
template <class D, class Block, typename T = hn::TFromD<D>, class Leaf>
HWY_INLINE void walk_shaft(D d, const PacketTree<Block>& tree, const Shaft<T>& shaft,
                           const Leaf& leaf) {
  using V = hn::Vec<D>;
  std::array<TreeChild, Tree::stack_size> stack;
  std::size_t size = 0;
  stack[size++] = TreeChild::node(0);
  while (size > 0) {
    const TreeChild child = stack[--size];
    if (child.is_leaf()) {
      if (leaf(child.index())) return;
      continue;
    }
    const TreeNode& node = tree.nodes[child.index()];
    for (std::size_t i = 0; i < TreeNode::width; i += hn::Lanes(d)) {
      V middle[3];
      V half[3];
      auto touched = hn::Eq(hn::Zero(d), hn::Zero(d));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const V low = load_bounds(d, node.low[axis].data() + i);
        const V high = load_bounds(d, node.high[axis].data() + i);
        touched = hn::And(touched, hn::And(hn::Le(low, hn::Set(d, shaft.high[axis])),
                                           hn::Ge(high, hn::Set(d, shaft.low[axis]))));
        const V one_half = hn::Set(d, T(0.5));
        half[axis] = hn::Mul(hn::Sub(high, low), one_half);
        middle[axis] = hn::Add(low, half[axis]);
      }
      const V3<V> reach{half[0], half[1], half[2]};
      touched = hn::And(touched, shaft.may_touch(d, {middle[0], middle[1], middle[2]},
                                                 hn::Sqrt(dot(reach, reach))));
      for (std::uint64_t left = bits_of(d, touched); left != 0; left &= left - 1)
        stack[size++] = node.children[i + hwy::Num0BitsBelowLS1Bit_Nonzero64(left)];
    }
  }
}

/// Primitives of a tree that a shaft may touch, by their leaves.
struct ShaftCandidates {
  struct Candidate {
    std::uint32_t leaf;
    std::uint32_t place;
  };
  /// Of more, rays are better taken through the tree.
  static constexpr std::size_t most = 64;

  std::array<Candidate, most> candidates;
  std::size_t count = 0;
  bool is_complete = true;

  /// Adds those of a tree. may_touch(d, primitives, shaft) of a block's primitives leaves some out,
  /// of a kind that has it.
  template <class D, class Block, typename T = hn::TFromD<D>>
  HWY_INLINE void find(D d, const PacketTree<Block>& tree, const Shaft<T>& shaft) {
    walk_shaft(d, tree, shaft, [&](std::uint32_t leaf) HWY_ATTR {
      const Block& block = tree.leaves[leaf];
      for (std::size_t i = 0; i < block.count; i += hn::Lanes(d)) {
        auto touched = hn::FirstN(d, block.count - i);
        const auto primitives = side_by_side(d, block, i);
        if constexpr (requires { may_touch(d, primitives, shaft); })
          touched = hn::And(touched, may_touch(d, primitives, shaft));
        for (std::uint64_t left = bits_of(d, touched); left != 0; left &= left - 1) {
          if (count == most) {
            is_complete = false;
            return true;
          }
          const std::size_t place = i + hwy::Num0BitsBelowLS1Bit_Nonzero64(left);
          candidates[count++] = {leaf, static_cast<std::uint32_t>(place)};
        }
      }
      return false;
    });
  }
};

/// Lanes of `lit` from which one of the candidates stands nearer than `distance`.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, class Block>
HWY_INLINE M occluded_by_candidates(D d, const PacketTree<Block>& tree,
                                    const ShaftCandidates& shaft, const RayOrigin<V>& from,
                                    const V3<V>& towards, V distance, M lit) {
  const TreeRays<V> rays{from, towards, towards, basis_across(d, towards)};
  M dark = hn::AndNot(lit, lit);
  for (std::size_t i = 0; i < shaft.count; ++i) {
    const auto& [leaf, place] = shaft.candidates[i];
    V t;
    const M hit = intersect(d, in_all_lanes(d, tree.leaves[leaf], place), rays, lit, t);
    dark = hn::Or(dark, hn::And(hit, hn::Lt(t, distance)));
  }
  return dark;
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
