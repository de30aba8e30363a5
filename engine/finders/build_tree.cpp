#include "engine/finders/build_tree.h"

#include <limits>
#include <utility>
#include <vector>

#include "engine/finders/parallel_split.h"

namespace raytracer {
namespace {

// From this depth on halves are equal in number, which ends after log8(2^32) = 11 more.
constexpr int deepest_by_heuristic = 40;
static_assert(deepest_by_heuristic + 12 <= Tree::deepest);

// Larger parts are no single task.
constexpr std::uint32_t least_parallel = 8192;
constexpr std::uint32_t subtree_count = 32;  // about so many tasks

using Children = std::vector<Part>;

/// Nodes in the making; within a subtree, its children are numbered from its own first.
class Nodes {
 public:
  std::vector<TreeNode> nodes;
  std::vector<std::uint32_t> leaf_begins;

  explicit Nodes(TreeRecord* records) : records_(records) {}

  /// Two parts of one; with `together` on all threads.
  std::pair<Part, Part> split(const Part& part, int depth, ParallelSplit* together) const {
    const Range& range = part.range;
    if (depth < deepest_by_heuristic) {
      const BinScale scale(part);
      Bins bins;
      if (together != nullptr)
        bins = together->count(range, scale);
      else
        bins.count(scale, records_, range);
      if (const std::optional<Cut> cut = best_cut(bins, scale)) {
        const Sides sides = together != nullptr ? together->partition(range, scale, *cut)
                                                : partition(records_, range, scale, *cut);
        return {{{range.begin, sides.middle}, cut->below, sides.below},
                {{sides.middle, range.end}, cut->above, sides.above}};
      }
    }
    // Too deep, or all centres in one place: any halves will do.
    const std::uint32_t middle = range.begin + range.size() / 2;
    return {bound(records_, {range.begin, middle}), bound(records_, {middle, range.end})};
  }

  /// Up to eight parts of one that a leaf cannot hold. Those that hold more than `least_together`
  /// are split on all threads.
  Children split_to_children(const Part& part, int depth, ParallelSplit* together,
                             std::uint32_t least_together) const {
    Children children{part};
    while (children.size() < TreeNode::width) {
      // The largest, by area or, where that has led too deep, by number.
      std::size_t largest = children.size();
      float most = -1;
      for (std::size_t i = 0; i < children.size(); ++i) {
        if (children[i].range.size() <= Tree::leaf_size) continue;
        const float measure = depth < deepest_by_heuristic
                                  ? children[i].box.half_area()
                                  : static_cast<float>(children[i].range.size());
        if (measure > most) {
          most = measure;
          largest = i;
        }
      }
      if (largest == children.size()) break;
      const bool is_large = children[largest].range.size() > least_together;
      const auto [first, second] = split(children[largest], depth, is_large ? together : nullptr);
      children[largest] = first;
      children.insert(children.begin() + static_cast<std::ptrdiff_t>(largest) + 1, second);
    }
    return children;
  }

  /// Adds a node with its children's boxes.
  std::uint32_t add_node(const Children& children) {
    constexpr float endless = std::numeric_limits<float>::infinity();
    TreeNode node;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node.low[axis].fill(endless);
      node.high[axis].fill(-endless);
      for (std::size_t i = 0; i < children.size(); ++i) {
        node.low[axis][i] = children[i].box.low[static_cast<int>(axis)];
        node.high[axis][i] = children[i].box.high[static_cast<int>(axis)];
      }
    }
    node.child_count = static_cast<std::uint32_t>(children.size());
    nodes.push_back(node);
    return static_cast<std::uint32_t>(nodes.size() - 1);
  }

  /// Adds the tree below a part, on this thread alone.
  TreeChild add_subtree(const Part& part, int depth) {
    if (part.range.size() <= Tree::leaf_size) {
      leaf_begins.push_back(part.range.begin);
      return TreeChild::leaf(static_cast<std::uint32_t>(leaf_begins.size() - 1));
    }
    const Children children = split_to_children(part, depth, nullptr, 0);
    const std::uint32_t node = add_node(children);
    for (std::size_t i = 0; i < children.size(); ++i) {
      const TreeChild child = add_subtree(children[i], depth + 1);
      nodes[node].children[i] = child;
    }
    return TreeChild::node(node);
  }

 private:
  TreeRecord* records_;
};

/// A part that is left to a task, and whose child it is.
struct Subtree {
  Part part;
  int depth;
  std::uint32_t parent;
  std::size_t place;
  Nodes nodes;
  TreeChild root;
};

/// The nodes above the subtrees, in whose order these are listed.
class Top {
 public:
  Top(TreeRecord* records, std::uint32_t count, WorkerPool& pool)
      : records_(records),
        nodes_(records),
        together_(records, pool),
        most_in_subtree_(std::max(least_parallel, count / subtree_count)) {
    add_node(together_.bound({0, count}), 0);
  }

  std::vector<Subtree> subtrees;

  std::vector<TreeNode>& nodes() { return nodes_.nodes; }

 private:
  std::uint32_t add_node(const Part& part, int depth) {
    const Children children =
        nodes_.split_to_children(part, depth, &together_, most_in_subtree_ / 4);
    const std::uint32_t node = nodes_.add_node(children);
    for (std::size_t i = 0; i < children.size(); ++i) {
      if (children[i].range.size() > most_in_subtree_) {
        const std::uint32_t child = add_node(children[i], depth + 1);
        nodes_.nodes[node].children[i] = TreeChild::node(child);
      } else {
        subtrees.push_back({children[i], depth + 1, node, i, Nodes(records_), {}});
      }
    }
    return node;
  }

  TreeRecord* const records_;
  Nodes nodes_;
  ParallelSplit together_;
  const std::uint32_t most_in_subtree_;
};

TreeChild moved(TreeChild child, std::uint32_t first_node, std::uint32_t first_leaf) {
  return child.is_leaf() ? TreeChild::leaf(child.index() + first_leaf)
                         : TreeChild::node(child.index() + first_node);
}

}  // namespace

Tree build_tree(TreeRecord* records, std::uint32_t count, WorkerPool& pool) {
  Tree tree;
  if (count == 0) return tree;
  Top top(records, count, pool);
  pool.run(top.subtrees.size(), [&](std::size_t i) {
    Subtree& subtree = top.subtrees[i];
    subtree.root = subtree.nodes.add_subtree(subtree.part, subtree.depth);
  });

  // The records stay where they are from here on.
  tree.nodes = std::move(top.nodes());
  for (const Subtree& subtree : top.subtrees) {
    const auto first_node = static_cast<std::uint32_t>(tree.nodes.size());
    const auto first_leaf = static_cast<std::uint32_t>(tree.leaf_begins.size());
    tree.nodes[subtree.parent].children[subtree.place] =
        moved(subtree.root, first_node, first_leaf);
    for (TreeNode node : subtree.nodes.nodes) {
      for (TreeChild& child : node.children) child = moved(child, first_node, first_leaf);
      tree.nodes.push_back(node);
    }
    tree.leaf_begins.insert(tree.leaf_begins.end(), subtree.nodes.leaf_begins.begin(),
                            subtree.nodes.leaf_begins.end());
  }
  tree.leaf_begins.push_back(count);
  tree.order.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) tree.order[i] = records[i].index();
  return tree;
}

}  // namespace raytracer
