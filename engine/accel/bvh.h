// What finds a scene's primitives for one ray after the other: a tree over its spheres and one over
// its triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "engine/accel/box.h"
#include "engine/accel/primitive_trees.h"
#include "engine/accel/tree.h"
#include "engine/accel/unbounded.h"
#include "engine/pack/packed_scene.h"
#include "engine/parallel/worker_pool.h"

namespace raytracer {

/// Refers to the scene, which must outlive it.
class Bvh {
 public:
  /// On the pool's threads.
  static Bvh build(const PackedScene& scene, WorkerPool& pool) {
    return {scene, build_sphere_tree(scene.spheres, pool),
            build_triangle_tree(scene.triangles, pool)};
  }

  template <typename Query>
  void visit(Query& query) const {
    show_unbounded(*scene_, query);
    const BoxRay ray(query.ray());
    visit(spheres_, scene_->spheres, ray, query);
    visit(triangles_, scene_->triangles, ray, query);
  }

 private:
  Bvh(const PackedScene& scene, Tree spheres, Tree triangles)
      : scene_(&scene), spheres_(std::move(spheres)), triangles_(std::move(triangles)) {}

  struct Entry {
    TreeChild child;
    double enter;
  };

  template <typename Primitives, typename Query>
  static void visit(const Tree& tree, const Primitives& primitives, const BoxRay& ray,
                    Query& query) {
    if (tree.nodes.empty()) return;
    std::array<Entry, Tree::stack_size> stack;
    std::size_t size = 0;
    stack[size++] = {TreeChild::node(0), 0};
    while (size > 0 && !query.is_settled()) {
      const Entry entry = stack[--size];
      if (entry.enter > query.t_max()) continue;
      const std::uint32_t index = entry.child.index();
      if (entry.child.is_leaf()) {
        for (std::uint32_t i = tree.leaf_begins[index]; i < tree.leaf_begins[index + 1]; ++i)
          query.show(primitives[tree.order[i]]);
        continue;
      }
      const TreeNode& node = tree.nodes[index];
      const std::size_t first = size;
      for (std::size_t i = 0; i < node.child_count; ++i) {
        const Box box{{node.low[0][i], node.low[1][i], node.low[2][i]},
                      {node.high[0][i], node.high[1][i], node.high[2][i]}};
        const double enter = ray.enter(box, query.t_max());
        if (enter == std::numeric_limits<double>::infinity()) continue;
        // The nearest goes on top.
        std::size_t place = size++;
        for (; place > first && stack[place - 1].enter < enter; --place)
          stack[place] = stack[place - 1];
        stack[place] = {node.children[i], enter};
      }
    }
  }

  const PackedScene* scene_;
  Tree spheres_;
  Tree triangles_;
};

}  // namespace raytracer
