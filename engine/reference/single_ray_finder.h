// What finds a scene's primitives for one ray after the other: each of them, or a tree over those
// of a kind, as the table says. One by one is the definition of what a ray meets.
#pragma once

#include <array>
#include <span>

#include "engine/finders/primitive_tree.h"
#include "engine/pack/packed_scene.h"
#include "engine/parallel/worker_pool.h"
#include "engine/plan/finders.h"

namespace raytracer {

/// Refers to the scene, which must outlive it.
class SingleRayFinder {
 public:
  /// Each primitive.
  explicit SingleRayFinder(const PackedScene& scene) : scene_(&scene) {}

  /// Trees where the table has them for rays from the eye, on the pool's threads.
  SingleRayFinder(const PackedScene& scene, const FinderTable& table, WorkerPool& pool)
      : scene_(&scene) {
    for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
      if constexpr (Kind::search == Search::bounded)
        if (finder_of(table[kind_index<Kind>], RayKind::from_eye) == Finder::tree)
          trees_[kind_index<Kind>] =
              build_primitive_tree(std::span(of_kind<Kind>(scene.primitives)), pool);
    });
  }

  template <typename Query>
  void visit(Query& query) const {
    for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
      const auto& primitives = of_kind<Kind>(scene_->primitives);
      const Tree& tree = trees_[kind_index<Kind>];
      if (query.is_settled() || primitives.empty()) return;
      if (tree.nodes.empty()) {
        for (const auto& primitive : primitives) query.add(primitive);
        return;
      }
      visit_tree(tree, BoxRay(query.ray()), query.t_max(), [&](std::uint32_t i) {
        query.add(primitives[i]);
        return query.is_settled();
      });
    });
  }

 private:
  const PackedScene* scene_;
  std::array<Tree, ObjectKinds::count> trees_;  ///< empty where each primitive is tried
};

}  // namespace raytracer
