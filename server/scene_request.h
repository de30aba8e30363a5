// From a request to the scene that it wants drawn.
#pragma once

#include "engine/engine.h"
#include "server/body_memory.h"
#include "server/call.h"
#include "server/query.h"
#include "server/scenes.h"

namespace raytracer {

struct Services;

struct SceneRequest : SceneView {
  double parse_ms = 0;       ///< to find or read the scene, and to judge the view
  BodyMemory::Share memory;  ///< of the body that came with the request
};

/// The scene that the query names, or else the body's, with the query's values over its own.
/// Throws Refusal for everything that can be wrong with either, and 503 while draining.
SceneRequest read_scene_request(Call& call, const RenderQuery& query, Services& services);

}  // namespace raytracer
