// Many rays through a tree at once: into each node go all that enter it, one after another against
// all of its boxes (R. Barringer, T. Akenine-Möller: "Dynamic Ray Stream Traversal", 2014).
//
// For rays that have nothing in common. What a node is asked for is loaded once for all of them,
// and the processor need not guess where each goes next: mirroring spheres take 0.7 of the time.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "engine/memory/aligned_array.h"
#include "engine/packets/padding.h"

HWY_BEFORE_NAMESPACE();
namespace raytracer::HWY_NAMESPACE {

/// Up to `most` rays side by side: what they have met, and how the boxes of nodes see them, as a
/// NodeRay each.
template <typename T, std::size_t most>
class StreamRays {
 public:
  alignas(64) T t[most];   ///< of the nearest hit
  alignas(64) T id[most];  ///< -1: none

  /// What the rays from the i-th on have met.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE void set_hit(D d, std::size_t i, const Hit<V>& hit) {
    hn::Store(hit.t, d, t + i);
    hn::Store(hit.id, d, id + i);
  }

  /// Where they go; to be called once it is known what they have met.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE void set_ray(D d, std::size_t i, const TreeRays<V>& rays) {
    const V3<V>& from = rays.from.point;
    const V3<V>& inverse = rays.inverse;
    set_axis(d, i, 0, from.x, inverse.x);
    set_axis(d, i, 1, from.y, inverse.y);
    set_axis(d, i, 2, from.z, inverse.z);
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) note_hit(i + lane);
  }

  /// To be called once a ray's t is less than it was.
  HWY_INLINE void note_hit(std::size_t ray) { reach_[ray] = box_reach(t[ray]); }

  /// As enters(); lowers `nearest` to where the boxes are entered that are.
  HWY_INLINE std::uint32_t entered_by(std::size_t ray, const TreeNode& node, float* nearest) const {
    const NodeTag d;
    std::uint32_t entered = 0;
    for (std::size_t i = 0; i < TreeNode::width; i += hn::Lanes(d)) {
      NodeVec t_begin = hn::Zero(d);
      NodeVec t_end = hn::Set(d, std::numeric_limits<float>::max());
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const NodeVec inverse = hn::Set(d, inverse_[axis][ray]);
        const NodeVec low = hn::Mul(
            hn::Sub(hn::LoadU(d, node.low[axis].data() + i), hn::Set(d, from_low_[axis][ray])),
            inverse);
        const NodeVec high = hn::Mul(
            hn::Sub(hn::LoadU(d, node.high[axis].data() + i), hn::Set(d, from_high(axis)[ray])),
            inverse);
        // Of what is no number the second is taken: such a box is entered.
        t_begin = hn::Max(hn::Min(low, high), t_begin);
        t_end = hn::Min(hn::Max(low, high), t_end);
      }
      const auto enter = hn::Le(
          t_begin, hn::Min(hn::Mul(t_end, hn::Set(d, generous<float>)), hn::Set(d, reach_[ray])));
      const NodeVec before = hn::Load(d, nearest + i);
      hn::Store(hn::IfThenElse(enter, hn::Min(before, t_begin), before), d, nearest + i);
      entered |= static_cast<std::uint32_t>(bits_of(d, enter)) << i;
    }
    return entered & ((1U << node.child_count) - 1);  // the other boxes are inside out
  }

 private:
  static constexpr bool is_narrowed = sizeof(T) != sizeof(float);

  template <class D, class V = hn::Vec<D>>
  HWY_INLINE void set_axis(D, std::size_t i, std::size_t axis, V from, V inverse) {
    const hn::Rebind<float, D> singles;
    if constexpr (is_narrowed) {
      const auto narrow = hn::DemoteTo(singles, from);
      const auto slack = hn::Mul(hn::Set(singles, narrowing_slack), hn::Abs(narrow));
      hn::Store(hn::Add(narrow, slack), singles, from_low_[axis] + i);
      hn::Store(hn::Sub(narrow, slack), singles, from_high_[axis] + i);
      hn::Store(hn::DemoteTo(singles, inverse), singles, inverse_[axis] + i);
    } else {
      hn::Store(from, singles, from_low_[axis] + i);
      hn::Store(inverse, singles, inverse_[axis] + i);
    }
  }
  HWY_INLINE const float* from_high(std::size_t axis) const {
    return is_narrowed ? from_high_[axis] : from_low_[axis];
  }

  alignas(64) float from_low_[3][most];                     ///< for the boxes' low sides
  alignas(64) float from_high_[3][is_narrowed ? most : 1];  ///< and their high sides, if it differs
  alignas(64) float inverse_[3][most];                      ///< 1 / direction, finite
  alignas(64) float reach_[most];
};

/// Lists of rays, by their numbers: those of the children that are still to be tried, one behind
/// the other.
class StreamLists {
 public:
  using Number = std::uint32_t;
  /// Room for so many from `begin` on.
  HWY_INLINE Number* room(std::size_t begin, std::size_t count) {
    const std::size_t end = begin + count + packet_padding;
    if (capacity_ < end) enlarge(begin, 2 * end);
    return numbers_.get() + begin;
  }
  HWY_INLINE const Number* from(std::size_t begin) const { return numbers_.get() + begin; }

  /// Of the list in hand, of so many: a bit for each box of a node that a ray enters.
  HWY_INLINE std::uint8_t* entered(std::size_t count) {
    if (entered_.size() < count + packet_padding) entered_.resize(2 * (count + packet_padding));
    return entered_.data();
  }

 private:
  /// Keeps the first `kept` numbers.
  HWY_NOINLINE void enlarge(std::size_t kept, std::size_t capacity) {
    AlignedArray<Number> larger = make_aligned_array<Number>(capacity);
    std::copy_n(numbers_.get(), kept, larger.get());
    numbers_ = std::move(larger);
    capacity_ = capacity;
  }

  AlignedArray<Number> numbers_;
  std::size_t capacity_ = 0;
  std::vector<std::uint8_t> entered_;
};

/// Writes those of a list of rays that enter a child; returns how many.
HWY_INLINE std::uint32_t pick(const StreamLists::Number* list, const std::uint8_t* entered,
                              std::uint32_t count, std::uint32_t child, StreamLists::Number* to) {
  StreamLists::Number* next = to;
#if HWY_TARGET <= HWY_AVX3
  const hn::ScalableTag<StreamLists::Number> d;
  const hn::Rebind<std::uint8_t, decltype(d)> bytes;
  const auto bit = hn::Set(d, 1U << child);
  static_assert(hn::MaxLanes(decltype(d)()) <= packet_padding);
  for (std::uint32_t i = 0; i < count; i += static_cast<std::uint32_t>(hn::Lanes(d))) {
    const auto enters = hn::And(hn::TestBit(hn::PromoteTo(d, hn::LoadU(bytes, entered + i)), bit),
                                hn::FirstN(d, count - i));
    hn::StoreU(hn::Compress(hn::LoadU(d, list + i), enters), d, next);
    next += count_true(d, enters);
  }
#else  // where Compress() is no instruction
  for (std::uint32_t i = 0; i < count; ++i) {
    *next = list[i];
    next += entered[i] >> child & 1U;
  }
#endif
  return static_cast<std::uint32_t>(next - to);
}

/// A child that is still to be tried, and the rays that enter it.
struct UntriedByStream {
  TreeChild child;
  std::uint32_t begin;  ///< of their list
  std::uint32_t count;
};

/// Takes rays to the leaves that they may need, near ones first: leaf(block, ray), which may lower
/// the ray's t.
template <class Block, class Rays, class Leaf>
HWY_INLINE void walk_stream(const PacketTree<Block>& tree, const Rays& rays,
                            std::span<const StreamLists::Number> numbers, StreamLists& lists,
                            const Leaf& leaf) {
  std::array<UntriedByStream, Tree::stack_size> stack;
  std::size_t size = 0;
  std::copy(numbers.begin(), numbers.end(), lists.room(0, numbers.size()));
  stack[size++] = {TreeChild::node(0), 0, static_cast<std::uint32_t>(numbers.size())};
  while (size > 0) {
    const UntriedByStream entry = stack[--size];
    // The list in hand is the last of all: behind it there is room for those of the children.
    std::uint32_t begin = entry.begin + entry.count;
    StreamLists::Number* to = lists.room(begin, TreeNode::width * entry.count);
    const StreamLists::Number* const list = lists.from(entry.begin);
    if (entry.child.is_leaf()) {
      const Block& block = tree.leaves[entry.child.index()];
      for (std::uint32_t i = 0; i < entry.count; ++i) leaf(block, list[i]);
      continue;
    }
    const TreeNode& node = tree.nodes[entry.child.index()];
    alignas(64) float nearest[TreeNode::width];
    std::fill_n(nearest, TreeNode::width, std::numeric_limits<float>::max());
    std::uint8_t* const entered = lists.entered(entry.count);
    std::uint32_t by_any = 0;
    for (std::uint32_t i = 0; i < entry.count; ++i) {
      const std::uint32_t by_ray = rays.entered_by(list[i], node, nearest);
      entered[i] = static_cast<std::uint8_t>(by_ray);
      by_any |= by_ray;
    }
    std::array<std::uint32_t, TreeNode::width> far_to_near;
    std::size_t child_count = 0;
    for (; by_any != 0; by_any &= by_any - 1) {
      const auto child = static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(by_any));
      std::size_t place = child_count++;
      for (; place > 0 && nearest[far_to_near[place - 1]] < nearest[child]; --place)
        far_to_near[place] = far_to_near[place - 1];
      far_to_near[place] = child;
    }
    for (std::size_t i = 0; i < child_count; ++i) {
      const std::uint32_t child = far_to_near[i];
      const std::uint32_t picked = pick(list, entered, entry.count, child, to);
      stack[size++] = {node.children[child], begin, picked};
      begin += picked;
      to += picked;
    }
  }
}

}  // namespace raytracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
