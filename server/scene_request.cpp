#include "server/scene_request.h"

#include <chrono>
#include <utility>

#include "engine/engine.h"
#include "server/body.h"
#include "server/problem.h"
#include "server/services.h"

namespace raytracer {
namespace {

SceneRequest read_document(std::string_view document, const RenderQuery& query, Services& services,
                           BodyMemory::Share memory) {
  const auto begin = std::chrono::steady_clock::now();
  Result<Scene> scene = read_scene(document, services.config.limits, query.overrides);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
  if (!scene.ok()) throw Refusal(scene_problem(scene.errors()));
  services.metrics.took(Stage::parse, took.count());
  return {std::move(scene).value(), took.count(), std::move(memory)};
}

}  // namespace

SceneRequest read_scene_request(Call& call, const RenderQuery& query, Services& services) {
  services.admission.demand_open();
  if (query.scene)
    return read_document(services.catalog.at(*query.scene).document, query, services, {});
  if (!call.content)
    throw Refusal({400, "Which scene? Name one of GET /scenes as ?scene=NAME, or POST a document"});
  BodyMemory::Share share = services.body_memory.take(body_length(call.request));
  const std::string body = read_body(call);
  return read_document(body, query, services, std::move(share));
}

}  // namespace raytracer
