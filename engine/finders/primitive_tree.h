// Trees over primitives of one kind.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/finders/build_tree.h"
#include "engine/finders/tree.h"
#include "engine/math/box.h"
#include "engine/parallel/chunks.h"

namespace raytracer {

/// A tree over primitives by their bounds(), on the pool's threads.
template <typename Primitive>
Tree build_primitive_tree(std::span<const Primitive> primitives, WorkerPool& pool) {
  const std::size_t chunk_count = pool.thread_count();
  std::vector<Box> boxes(chunk_count);
  for_each_chunk(primitives.size(), chunk_count, pool,
                 [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                   Box box;
                   for (std::size_t i = begin; i < end; ++i) box.include(bounds(primitives[i]));
                   boxes[chunk] = box;
                 });
  Box all;
  for (const Box& box : boxes) all.include(box);
  // A ray's origin is a point as far out as any primitive, rounded.
  const double magnitude = std::max(max_abs(all.low), max_abs(all.high));
  return build_tree(
      primitives.size(), [&](std::size_t i) { return bounds(primitives[i]).padded(magnitude); },
      pool);
}

/// One value of the primitives of a leaf.
template <typename T>
using BlockColumn = std::array<T, Tree::leaf_size>;

/// As packets read it: below the boxes the primitives themselves, eight to a block of columns, a
/// leaf a block.
template <typename Block>
struct PacketTree {
  std::vector<TreeNode> nodes;
  std::vector<Block> leaves;
};

/// `fill(primitive, place, block)` puts one into its block, from several threads.
template <typename Block, typename Primitive, typename Fill>
PacketTree<Block> build_packet_tree(std::span<const Primitive> primitives, const Fill& fill,
                                    WorkerPool& pool) {
  PacketTree<Block> packed;
  Tree tree = build_primitive_tree(primitives, pool);
  packed.nodes = std::move(tree.nodes);
  if (packed.nodes.empty()) return packed;
  const std::size_t count = tree.leaf_begins.size() - 1;
  packed.leaves.resize(count);
  for_each_chunk(count, pool.thread_count(), pool,
                 [&](std::size_t, std::size_t begin, std::size_t end) {
                   for (std::size_t leaf = begin; leaf < end; ++leaf) {
                     const std::uint32_t first = tree.leaf_begins[leaf];
                     Block block = Block::empty();
                     block.count = tree.leaf_begins[leaf + 1] - first;
                     for (std::uint32_t i = 0; i < block.count; ++i)
                       fill(primitives[tree.order[first + i]], i, block);
                     packed.leaves[leaf] = block;
                   }
                 });
  return packed;
}

/// Calls visit(primitive's index) for those that one ray may meet before `t_max`, which visit() may
/// lower, near ones first, until it says that it is settled.
template <typename Visit>
void visit_tree(const Tree& tree, const BoxRay& ray, const double& t_max, const Visit& visit) {
  struct Entry {
    TreeChild child;
    double enter;
  };
  if (tree.nodes.empty()) return;
  std::array<Entry, Tree::stack_size> stack;
  std::size_t size = 0;
  stack[size++] = {TreeChild::node(0), 0};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.enter > t_max) continue;
    const std::uint32_t index = entry.child.index();
    if (entry.child.is_leaf()) {
      for (std::uint32_t i = tree.leaf_begins[index]; i < tree.leaf_begins[index + 1]; ++i)
        if (visit(tree.order[i])) return;
      continue;
    }
    const TreeNode& node = tree.nodes[index];
    const std::size_t first = size;
    for (std::size_t i = 0; i < node.child_count; ++i) {
      const Box box{{node.low[0][i], node.low[1][i], node.low[2][i]},
                    {node.high[0][i], node.high[1][i], node.high[2][i]}};
      const double enter = ray.enter(box, t_max);
      if (enter == infinity) continue;
      // The nearest goes on top.
      std::size_t place = size++;
      for (; place > first && stack[place - 1].enter < enter; --place)
        stack[place] = stack[place - 1];
      stack[place] = {node.children[i], enter};
    }
  }
}

}  // namespace raytracer
