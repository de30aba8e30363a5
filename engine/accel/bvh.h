// A binary tree of boxes over spheres and triangles, built by the surface area heuristic over
// bins (Wald: "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/accel/box.h"
#include "engine/accel/unbounded.h"
#include "engine/pack/packed_scene.h"

namespace raytracer {

/// Refers to the scene, which must outlive it.
class Bvh {
 public:
  struct Node {
    Box box;
    std::uint32_t first;  ///< leaf: into order(); inner: the first of two children
    std::uint32_t count;  ///< leaf: of primitives; inner: 0
    int axis;             ///< inner: of the split; the first child is on its lower side
  };

  /// Deeper than this the tree is split in the middle, so that a stack of fixed size suffices.
  static constexpr int deepest_by_heuristic = 48;
  static constexpr int deepest = deepest_by_heuristic + 32;

  static Bvh build(const PackedScene& scene);

  /// The root first; children side by side. Empty if there is nothing to find.
  const std::vector<Node>& nodes() const { return nodes_; }
  /// Primitives by leaf: spheres are numbered first, then triangles.
  const std::vector<std::uint32_t>& order() const { return order_; }

  template <typename Query>
  void visit(Query& query) const {
    show_unbounded(*scene_, query);
    if (nodes_.empty()) return;
    const BoxRay ray(query.ray());
    std::array<Entry, deepest + 1> stack;
    std::size_t size = 0;
    const auto push = [&](std::uint32_t node) {
      const double enter = ray.enter(nodes_[node].box, query.t_max());
      if (enter < std::numeric_limits<double>::infinity()) stack[size++] = {node, enter};
    };
    push(0);
    while (size > 0 && !query.is_settled()) {
      const Entry entry = stack[--size];
      if (entry.enter > query.t_max()) continue;
      const Node& node = nodes_[entry.node];
      if (node.count > 0) {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) show(i, query);
        continue;
      }
      push(node.first);
      push(node.first + 1);
      // The nearer child goes on top.
      if (size >= 2 && stack[size - 2].node == node.first &&
          stack[size - 2].enter < stack[size - 1].enter)
        std::swap(stack[size - 2], stack[size - 1]);
    }
  }

 private:
  struct Entry {
    std::uint32_t node;
    double enter;
  };
  struct Builder;

  template <typename Query>
  void show(std::uint32_t place, Query& query) const {
    const std::uint32_t primitive = order_[place];
    const auto sphere_count = static_cast<std::uint32_t>(scene_->spheres.size());
    if (primitive < sphere_count)
      query.show(scene_->spheres[primitive]);
    else
      query.show(scene_->triangles[primitive - sphere_count]);
  }

  const PackedScene* scene_ = nullptr;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace raytracer
