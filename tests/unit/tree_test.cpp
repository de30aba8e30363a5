// The tree holds every primitive once, in boxes that lose none, whatever the number of threads.

#include "engine/finders/tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/finders/build_tree.h"
#include "tests/support/rays.h"

namespace raytracer::test {
namespace {

std::vector<Box> random_boxes(std::size_t count, double size, std::uint64_t seed) {
  Random random(seed);
  std::vector<Box> boxes(count);
  for (Box& box : boxes) {
    const Vec3 low = random.point(-1, 1);
    box = {low, low + size * random.point(0, 1)};
  }
  return boxes;
}

Tree tree_of(const std::vector<Box>& boxes, std::size_t threads) {
  WorkerPool pool(threads);
  return build_tree(
      boxes.size(), [&](std::size_t i) { return boxes[i]; }, pool);
}

/// Walks the tree and checks each primitive against the boxes of all nodes above it.
class Inspector {
 public:
  Inspector(const Tree& tree, const std::vector<Box>& boxes)
      : tree_(tree), boxes_(boxes), times_seen_(boxes.size(), 0) {
    if (!tree.nodes.empty()) inspect_node(0, 1, {});
    EXPECT_EQ(std::count(times_seen_.begin(), times_seen_.end(), 1),
              static_cast<std::ptrdiff_t>(boxes.size()));
    EXPECT_LE(deepest_, Tree::deepest);
  }

 private:
  void inspect_node(std::uint32_t index, int depth, const std::vector<Box>& above) {
    deepest_ = std::max(deepest_, depth);
    const TreeNode& node = tree_.nodes.at(index);
    ASSERT_GE(node.child_count, 1U);
    for (std::size_t i = 0; i < TreeNode::width; ++i) {
      if (i >= node.child_count) {
        EXPECT_GT(node.low[0][i], node.high[0][i]);
        continue;
      }
      std::vector<Box> boxes = above;
      boxes.push_back({{node.low[0][i], node.low[1][i], node.low[2][i]},
                       {node.high[0][i], node.high[1][i], node.high[2][i]}});
      if (node.children[i].is_leaf())
        inspect_leaf(node.children[i].index(), boxes);
      else
        inspect_node(node.children[i].index(), depth + 1, boxes);
    }
  }

  void inspect_leaf(std::uint32_t leaf, const std::vector<Box>& above) {
    const std::uint32_t begin = tree_.leaf_begins.at(leaf);
    const std::uint32_t end = tree_.leaf_begins.at(leaf + 1);
    ASSERT_LT(begin, end);
    EXPECT_LE(end - begin, Tree::leaf_size);
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint32_t primitive = tree_.order.at(i);
      ++times_seen_.at(primitive);
      for (const Box& box : above) {
        Box all = box;
        all.include(boxes_.at(primitive));
        EXPECT_EQ(all.low, box.low);
        EXPECT_EQ(all.high, box.high);
      }
    }
  }

  const Tree& tree_;
  const std::vector<Box>& boxes_;
  std::vector<int> times_seen_;
  int deepest_ = 0;
};

TEST(Tree, of_nothing_has_no_nodes) { EXPECT_TRUE(tree_of({}, 1).nodes.empty()); }

TEST(Tree, holds_every_primitive_once_in_boxes_that_bound_it) {
  for (const std::size_t count : {1U, 2U, 8U, 9U, 63U, 500U, 9000U, 40'000U}) {
    const std::vector<Box> boxes = random_boxes(count, 0.02, count);
    Inspector(tree_of(boxes, 2), boxes);
  }
}

TEST(Tree, bounds_what_single_cannot_hold) {
  Random random(41);
  std::vector<Box> boxes;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 place = random.point(-1, 1) * std::abs(random.magnitude(-60, 6));
    boxes.push_back({place, place});
  }
  Inspector(tree_of(boxes, 2), boxes);
}

TEST(Tree, of_primitives_in_one_place_is_split_anyhow) {
  const std::vector<Box> boxes(30'000, Box{{0, 0, 0}, {1, 1, 1}});
  Inspector(tree_of(boxes, 2), boxes);
}

TEST(Tree, of_a_long_chain_stays_within_its_depth) {
  std::vector<Box> boxes;
  for (int i = 0; i < 120; ++i)
    for (int k = 0; k < 40; ++k) {
      const double place = std::ldexp(1.0, -i) * (1 + 1e-3 * k);
      boxes.push_back({{place, -place, 0}, {place * 1.1, place, place}});
    }
  Inspector(tree_of(boxes, 2), boxes);
}

TEST(Tree, does_not_depend_on_the_number_of_threads) {
  const std::vector<Box> boxes = random_boxes(100'000, 0.05, 7);
  const Tree expected = tree_of(boxes, 1);
  for (const std::size_t threads : {2U, 3U, 5U}) {
    const Tree tree = tree_of(boxes, threads);
    EXPECT_EQ(tree.order, expected.order);
    EXPECT_EQ(tree.leaf_begins, expected.leaf_begins);
    ASSERT_EQ(tree.nodes.size(), expected.nodes.size());
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
      EXPECT_EQ(tree.nodes[i].low, expected.nodes[i].low);
      EXPECT_EQ(tree.nodes[i].high, expected.nodes[i].high);
    }
  }
}

}  // namespace
}  // namespace raytracer::test
