// /scenes: what can be drawn without sending it.
#include <nlohmann/json.hpp>
#include <utility>

#include "server/answer.h"
#include "server/handlers.h"
#include "server/problem.h"
#include "server/scene_request.h"

namespace raytracer {

namespace {

nlohmann::ordered_json list_of(const Catalog& catalog) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ShippedScene& scene : catalog.scenes()) {
    const SceneDescription about = describe(scene);
    list.push_back({{"name", scene.name},
                    {"title", about.title},
                    {"description", about.description},
                    {"width", about.width_px},
                    {"height", about.height_px}});
  }
  return {{"scenes", list}};
}

}  // namespace

void get_scenes(Services& services, Call& call) {
  static const nlohmann::ordered_json list =
      list_of(services.catalog);  // a program's are always the same
  answer_json(call.response, 200, list);
}

void get_scene(Services& services, Call& call) {
  answer_shared_bytes(call.response, services.scenes.document(call.captured), "application/json");
}

void post_scene(Services& services, Call& call) {
  if (!call.request.params.empty())
    refuse(400, "POST /scenes takes no query: views of the scene say theirs later");
  PostedDocument posted = read_document(call, services);
  const SceneView view = find_scene(posted.text, {}, services);
  const Scene& scene = view.known->scene;
  const auto kept = services.scenes.keep(view.known, std::move(posted.text));
  if (services.cluster) services.cluster->keep_scene(kept->id, kept->document);
  answer_json(call.response, 201,
              {{"id", kept->id},
               {"objects", count_objects(scene)},
               {"lights", scene.lights.size()},
               {"width", scene.camera.width},
               {"height", scene.camera.height},
               {"bytes", kept->bytes},
               {"render", "/render?scene=" + kept->id}});
  call.response.set_header("Location", "/scenes/" + kept->id);
}

}  // namespace raytracer
