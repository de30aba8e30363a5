// What a PreparedScene holds, for the stages that trace it.
#pragma once

#include "engine/plan/plan.h"
#include "engine/render/tracer.h"
#include "engine/scene/scene.h"

namespace raytracer {

struct BuiltScene {
  const Scene& scene;
  Plan plan;
  Tracer tracer;
  double plan_ms;  ///< that it took to pack and to plan
  double build_ms;
};

}  // namespace raytracer
