// What the engine will do for a scene, decided once: nothing downstream decides it again.
#pragma once

#include "engine/plan/frame.h"
#include "engine/scene/scene.h"

namespace raytracer {

struct Plan {
  enum class Structure { none, bvh };

  Frame frame;
  Structure structure = Structure::none;  ///< over the spheres and triangles
};

Plan make_plan(const Scene& scene);

}  // namespace raytracer
