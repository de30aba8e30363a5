// No structure: every primitive is shown to every query. The definition of what a ray meets, and
// the fastest way where there are few.
#pragma once

#include "engine/accel/unbounded.h"
#include "engine/pack/packed_scene.h"

namespace raytracer {

/// Refers to the scene, which must outlive it.
class BruteForce {
 public:
  explicit BruteForce(const PackedScene& scene) : scene_(scene) {}

  template <typename Query>
  void visit(Query& query) const {
    show_unbounded(scene_, query);
    for (const PackedSphere& sphere : scene_.spheres) query.show(sphere);
    for (const PackedTriangle& triangle : scene_.triangles) query.show(triangle);
  }

 private:
  const PackedScene& scene_;
};

}  // namespace raytracer
