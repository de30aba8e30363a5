// What a packet meets in a tree: its lanes together where their rays have something in common, else
// each on its own.

#include <cstddef>
#include <limits>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// The rays of a packet, to be taken out one by one.
template <typename T>
class PacketLanes {
 public:
  static constexpr std::size_t most = HWY_MAX_BYTES / sizeof(T);

  template <class D, class V, class Origin>
  HWY_INLINE PacketLanes(D d, const TreeRays<V, Origin>& rays) {
    const RayOrigin<V>& from = rays.from;
    const V columns[] = {from.point.x,     from.point.y,     from.point.z,   from.normal.x,
                         from.normal.y,    from.normal.z,    from.id,        rays.direction.x,
                         rays.direction.y, rays.direction.z, rays.inverse.x, rays.inverse.y,
                         rays.inverse.z};
    for (std::size_t i = 0; i < column_count; ++i) hn::Store(columns[i], d, values_[i]);
  }

  /// A lane's ray in all lanes.
  template <class Origin, class D, class V = hn::Vec<D>>
  HWY_INLINE TreeRays<V, Origin> ray(D d, std::size_t lane) const {
    const auto at = [&](std::size_t i) HWY_ATTR { return hn::Set(d, values_[i][lane]); };
    const V3<V> direction{at(7), at(8), at(9)};
    return {Origin{RayOrigin<V>{
                {at(0), at(1), at(2)}, {at(3), at(4), at(5)}, at(6), hn::Zero(d), hn::Zero(d)}},
            direction,
            {at(10), at(11), at(12)},
            basis_across(d, direction)};
  }

  /// The same for boxes.
  HWY_INLINE NodeRay node_ray(std::size_t lane) const {
    const auto at = [&](std::size_t i) { return values_[i][lane]; };
    return node_ray_of<T>({at(0), at(1), at(2)}, {at(10), at(11), at(12)});
  }

 private:
  static constexpr std::size_t column_count = 13;
  alignas(64) T values_[column_count][most];
};

/// A block's primitives from i on, one to a lane.
template <class D, class Block, typename T = hn::TFromD<D>>
HWY_INLINE auto side_by_side(D d, const Block& block, std::size_t i) {
  return lanes_of(
      block, [&](const BlockColumn<T>& column) HWY_ATTR { return hn::Load(d, column.data() + i); });
}

/// A block's primitive i in all lanes.
template <class D, class Block, typename T = hn::TFromD<D>>
HWY_INLINE auto in_all_lanes(D d, const Block& block, std::size_t i) {
  return lanes_of(block,
                  [&](const BlockColumn<T>& column) HWY_ATTR { return hn::Set(d, column[i]); });
}

/// One ray against a block: the nearest that it has met.
template <class D, class Origin, class V = hn::Vec<D>, typename T = hn::TFromD<D>, class Block>
HWY_INLINE void intersect_block(D d, const Block& block, const TreeRays<V, Origin>& ray,
                                T& nearest_t, T& nearest_id) {
  for (std::size_t i = 0; i < block.count; i += hn::Lanes(d)) {
    V t;
    const auto hit =
        intersect(d, side_by_side(d, block, i), ray, hn::FirstN(d, block.count - i), t);
    const auto counts = hn::And(hit, hn::Le(t, hn::Set(d, nearest_t)));
    if (hn::AllFalse(d, counts)) continue;
    const V none = hn::Set(d, std::numeric_limits<T>::max());
    const V least_t = hn::MinOfLanes(d, hn::IfThenElse(counts, t, none));
    const V ids = hn::Load(d, block.id.data() + i);
    const auto nearest = hn::And(counts, hn::Eq(t, least_t));
    const T id = hn::GetLane(hn::MinOfLanes(d, hn::IfThenElse(nearest, ids, none)));
    const T first_t = hn::GetLane(least_t);
    if (first_t < nearest_t || id < nearest_id) {
      nearest_t = first_t;
      nearest_id = id;
    }
  }
}

/// How much the directions of n active lanes have in common, as the square of their mean: 1 if they
/// are the same, 1 / n on average if they are random.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, typename T = hn::TFromD<D>>
HWY_INLINE T agreement(D d, const V3<V>& direction, M active) {
  const auto sum = [&](V slope) HWY_ATTR {
    return hn::GetLane(hn::SumOfLanes(d, hn::IfThenElseZero(active, slope)));
  };
  const T x = sum(direction.x);
  const T y = sum(direction.y);
  const T z = sum(direction.z);
  const auto count = static_cast<T>(count_true(d, active));
  return (x * x + y * y + z * z) / (count * count);
}

/// Whether a packet is to go through a tree as one. Processor time in ms of all together, each
/// alone and by this rule: 1,000 mirroring spheres 49, 80, 50; 100,000 338, 214, 220; a mirroring
/// sphereflake 49, 91, 57. To try a single leaf's primitives together is as good at any time.
template <class D, class Block, class V = hn::Vec<D>, class M = hn::Mask<D>>
HWY_INLINE bool go_together(D d, const PacketTree<Block>& tree, const V3<V>& direction, M active) {
  using T = hn::TFromD<D>;
  if (tree.leaves.size() == 1) return true;
  return agreement(d, direction, active) * static_cast<T>(count_true(d, active)) > T(2);
}

/// Calls visit(lane) for the lanes of `active`.
template <class D, class M = hn::Mask<D>, class Visit>
HWY_INLINE void for_each_lane(D d, M active, const Visit& visit) {
  for (std::uint64_t left = bits_of(d, active); left != 0; left &= left - 1)
    visit(hwy::Num0BitsBelowLS1Bit_Nonzero64(left));
}

/// The packet against the tree's primitives, each ray alone.
template <class D, template <class> class Origin, class V, class M = hn::Mask<D>,
          typename T = hn::TFromD<D>, class Block>
HWY_NOINLINE void intersect_tree_alone(D d, const PacketTree<Block>& tree,
                                       const TreeRays<V, Origin<V>>& rays, M active, Hit<V>& hit) {
  const EightTag<T> d8;
  const PacketLanes<T> lanes(d, rays);
  alignas(64) T nearest_t[PacketLanes<T>::most];
  alignas(64) T nearest_id[PacketLanes<T>::most];
  hn::Store(hit.t, d, nearest_t);
  hn::Store(hit.id, d, nearest_id);
  for_each_lane(d, active, [&](std::size_t lane) HWY_ATTR {
    const auto ray = lanes.template ray<Origin<hn::Vec<decltype(d8)>>>(d8, lane);
    walk_alone(tree, lanes.node_ray(lane), nearest_t[lane], [&](const Block& block) HWY_ATTR {
      intersect_block(d8, block, ray, nearest_t[lane], nearest_id[lane]);
      return false;
    });
  });
  hit.t = hn::Load(d, nearest_t);
  hit.id = hn::Load(d, nearest_id);
}

/// The packet against the tree's primitives.
template <class D, template <class> class Origin, class V = hn::Vec<D>, class M = hn::Mask<D>,
          class Block>
void intersect_tree(D d, const PacketTree<Block>& tree, const Origin<V>& from,
                    const V3<V>& direction, M active, Hit<V>& hit) {
  const TreeRays<V, Origin<V>> rays = tree_rays(d, from, direction);
  if (!go_together(d, tree, direction, active))
    return intersect_tree_alone(d, tree, rays, active, hit);
  walk_together(d, tree, rays, active, hit.t, [&](const Block& block, M lanes) HWY_ATTR {
    for (std::size_t i = 0; i < block.count; ++i) {
      V t;
      const auto columns = in_all_lanes(d, block, i);
      const M is_hit = intersect(d, columns, rays, lanes, t);
      take(hit, is_nearer(hit, t, columns.id, is_hit), t, columns.id);
    }
    return false;
  });
}

/// Rays of a stream against the tree's primitives; ray(d, i) is the one of that number in all
/// lanes.
template <class Block, class Ray, class Rays>
HWY_NOINLINE void intersect_tree(const PacketTree<Block>& tree,
                                 std::span<const StreamLists::Number> numbers, const Ray& ray,
                                 Rays& rays, StreamLists& lists) {
  const EightTag<std::remove_extent_t<decltype(rays.t)>> d;
  walk_stream(tree, rays, numbers, lists, [&](const Block& block, std::size_t i) HWY_ATTR {
    intersect_block(d, block, ray(d, i), rays.t[i], rays.id[i]);
    rays.note_hit(i);
  });
}

/// Lanes of `lit` from which something in the tree stands nearer than `distance`. Rays to a light
/// go together.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, class Block>
M occluded_in_tree(D d, const PacketTree<Block>& tree, const RayOrigin<V>& from,
                   const V3<V>& towards, V distance, M lit) {
  const auto rays = tree_rays(d, from, towards);
  M rest = lit;
  walk_together(d, tree, rays, rest, distance, [&](const Block& block, M lanes) HWY_ATTR {
    M clear = lanes;
    for (std::size_t i = 0; i < block.count && !hn::AllFalse(d, clear); ++i) {
      V t;
      const M hit = intersect(d, in_all_lanes(d, block, i), rays, clear, t);
      clear = hn::AndNot(hn::And(hit, hn::Lt(t, distance)), clear);
    }
    rest = hn::AndNot(hn::AndNot(clear, lanes), rest);
    return hn::AllFalse(d, rest);
  });
  return hn::AndNot(rest, lit);
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
