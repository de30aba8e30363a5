// A tree of boxes, eight to a node: one ray meets all boxes of a node at once, and the tree is
// shallow.
//
// Boxes are in single precision, rounded outward from what they bound: which primitive is met is
// never decided here.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/math/box.h"

namespace raytracer {

/// Names a node's child: another node, or a leaf.
class TreeChild {
 public:
  TreeChild() = default;  // names none: a stack of them must cost nothing to make
  static TreeChild node(std::uint32_t index) { return TreeChild(index); }
  static TreeChild leaf(std::uint32_t index) { return TreeChild(index | leaf_bit); }

  bool is_leaf() const { return (bits_ & leaf_bit) != 0; }
  std::uint32_t index() const { return bits_ & ~leaf_bit; }

 private:
  static constexpr std::uint32_t leaf_bit = 0x80000000U;
  explicit TreeChild(std::uint32_t bits) : bits_(bits) {}

  std::uint32_t bits_;
};

/// The boxes of up to eight children in columns. Children that are not there stand last and have
/// boxes that are inside out.
struct alignas(32) TreeNode {
  static constexpr std::size_t width = 8;

  std::array<std::array<float, width>, 3> low;   ///< by axis, by child
  std::array<std::array<float, width>, 3> high;  ///< by axis, by child
  std::array<TreeChild, width> children;
  std::uint32_t child_count = 0;
};

struct Tree {
  /// No leaf has more primitives.
  static constexpr std::uint32_t leaf_size = 8;
  /// Nodes on the way from the root to any leaf; see build_tree.cpp.
  static constexpr int deepest = 52;
  /// What a walk that keeps a node's untried children on a stack may have on it.
  static constexpr std::size_t stack_size = deepest * (TreeNode::width - 1) + 1;

  std::vector<TreeNode> nodes;             ///< the root first; none if there is nothing to find
  std::vector<std::uint32_t> leaf_begins;  ///< of each leaf in `order`, and the end of the last
  std::vector<std::uint32_t> order;        ///< the primitives, leaf by leaf
};

}  // namespace raytracer
