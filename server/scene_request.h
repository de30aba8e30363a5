// From a request to the scene that it wants drawn.
#pragma once

#include "engine/engine.h"
#include "server/body_memory.h"
#include "server/call.h"
#include "server/query.h"

namespace raytracer {

struct Services;

struct SceneRequest {
  Scene scene;
  double parse_ms = 0;
  BodyMemory::Share memory;  ///< of the body that the scene was read from
};

/// Reads the shipped scene that the query names, or else the body, with the query's values over
/// it. Throws Refusal for everything that can be wrong with either, and 503 while draining.
SceneRequest read_scene_request(Call& call, const RenderQuery& query, Services& services);

}  // namespace raytracer
