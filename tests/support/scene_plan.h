// The plan of a scene that is packed only for it.
#pragma once

#include <utility>

#include "engine/kernel/this_machine.h"
#include "engine/plan/plan.h"

namespace raytracer {

inline Plan make_plan(const Scene& scene, const Machine& machine, WorkerPool* pool = nullptr) {
  return make_plan(scene, pack_scene(scene, pool), machine, pool);
}

/// In double where the plan would mix: an edge that a mirror shows may be displaced by a small part
/// of a pixel, and by another on another instruction set.
inline Scene without_mixing(Scene scene) {
  if (make_plan(scene, this_machine()).precision.value == Precision::mixed)
    scene.render.precision = Precision::double_precision;
  return scene;
}

}  // namespace raytracer
