// The plan of a scene that is packed only for it.
#pragma once

#include "engine/plan/plan.h"

namespace raytracer {

inline Plan make_plan(const Scene& scene, const Machine& machine, WorkerPool* pool = nullptr) {
  return make_plan(scene, pack_scene(scene, pool), machine, pool);
}

}  // namespace raytracer
