#include "server/scene_request.h"

#include <chrono>
#include <utility>

#include "engine/engine.h"
#include "server/body.h"
#include "server/problem.h"
#include "server/services.h"

namespace raytracer {

SceneRequest read_scene_request(Call& call, const RenderQuery& query, Services& services) {
  services.admission.demand_open();
  if (!query.scene && !call.content)
    throw Refusal({400,
                   "Which scene? Name one of GET /scenes, or the id of one that was posted there, "
                   "as ?scene=NAME, or POST a document"});
  BodyMemory::Share share;
  std::string body;
  if (!query.scene) {
    const std::int64_t length = body_length(call.request);
    share = services.body_memory.take(length);
    body = read_body(call, length);
  }
  const auto begin = std::chrono::steady_clock::now();
  SceneView view = query.scene ? services.scenes.at(*query.scene, query.overrides)
                               : services.scenes.read(std::move(body), query.overrides);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
  services.metrics.took(Stage::parse, took.count());
  return {std::move(view), took.count(), std::move(share)};
}

}  // namespace raytracer
