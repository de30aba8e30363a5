#include "server/scene_request.h"

#include <chrono>
#include <utility>

#include "server/body.h"
#include "server/problem.h"

namespace raytracer {

PostedDocument read_document(Call& call, Services& services) {
  services.admission.require_open();
  PostedDocument posted;
  const std::int64_t length = body_length(call.request).value_or(0);
  posted.memory = services.body_memory.take(0);
  posted.text = read_body(call, length, *posted.memory);
  return posted;
}

SceneView find_scene(const DocumentText& document, const RenderQuery& query, Services& services) {
  const auto begin = std::chrono::steady_clock::now();
  SceneView view = query.scene ? services.scenes.at(*query.scene, query.overrides)
                               : services.scenes.read(document, query.overrides);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
  services.metrics.took("parse", took.count());
  view.parse_ms = took.count();
  return view;
}

SceneView read_scene_request(Call& call, const RenderQuery& query, Services& services) {
  if (!query.scene && !call.content)
    refuse(400,
           "Which scene? Name one of GET /scenes, or the id of one that was posted there, "
           "as ?scene=NAME, or POST a document");
  if (query.scene) {
    services.admission.require_open();
    SceneView view = find_scene("", query, services);
    if (services.cluster) view.document = services.scenes.document(*query.scene);
    return view;
  }
  PostedDocument posted = read_document(call, services);
  SceneView view = find_scene(posted.text, query, services);
  view.body_memory = std::move(posted.memory);
  if (services.cluster) view.document = std::make_shared<const std::string>(std::move(posted.text));
  return view;
}

}  // namespace raytracer
