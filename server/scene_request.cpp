#include "server/scene_request.h"

#include <chrono>
#include <utility>

#include "engine/engine.h"
#include "server/body.h"
#include "server/problem.h"
#include "server/services.h"

namespace raytracer {

PostedDocument read_document(Call& call, Services& services) {
  services.admission.require_open();
  PostedDocument posted;
  const std::int64_t length = body_length(call.request);
  posted.memory = services.body_budget.reserve(length);
  posted.text = read_body(call, length);
  return posted;
}

SceneRequest find_scene(std::string_view document, const RenderQuery& query, Services& services) {
  const auto begin = std::chrono::steady_clock::now();
  SceneView view = query.scene ? services.scenes.at(*query.scene, query.overrides)
                               : services.scenes.read(document, query.overrides);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
  services.metrics.took(Stage::parse, took.count());
  return {std::move(view), took.count(), {}};
}

SceneRequest read_scene_request(Call& call, const RenderQuery& query, Services& services) {
  if (!query.scene && !call.content)
    throw HttpError(
        {400,
         "Which scene? Name one of GET /scenes, or the id of one that was posted there, "
         "as ?scene=NAME, or POST a document"});
  if (query.scene) {
    services.admission.require_open();
    return find_scene({}, query, services);
  }
  PostedDocument posted = read_document(call, services);
  SceneRequest request = find_scene(posted.text, query, services);
  request.memory = std::move(posted.memory);
  return request;
}

}  // namespace raytracer
