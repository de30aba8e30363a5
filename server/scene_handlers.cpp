// /scenes: what can be drawn without sending it.
#include <nlohmann/json.hpp>

#include "server/answer.h"
#include "server/handlers.h"
#include "server/problem.h"
#include "server/query.h"
#include "server/scene_request.h"

namespace raytracer {

void get_scenes(Services& services, Call& call) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ShippedScene& scene : services.catalog.scenes())
    list.push_back({{"name", scene.name},
                    {"title", scene.title},
                    {"description", scene.description},
                    {"width", scene.width_px},
                    {"height", scene.height_px}});
  answer_json(call.response, 200, {{"scenes", list}});
}

void get_scene(Services& services, Call& call) {
  answer_bytes(call.response, services.scenes.document(call.captured), "application/json");
}

void post_scene(Services& services, Call& call) {
  if (!split_query(call.request.target).empty())
    throw Refusal({400, "POST /scenes takes no query: views of the scene say theirs later"});
  const SceneRequest request = read_scene_request(call, {}, services);
  const KnownScene& scene = *request.known;
  const std::string id = services.scenes.keep(request.known);
  answer_json(call.response, 201,
              {{"id", id},
               {"objects", count_objects(scene.scene)},
               {"lights", scene.scene.lights.size()},
               {"width", scene.scene.camera.width},
               {"height", scene.scene.camera.height},
               {"bytes", scene.bytes()},
               {"render", "/render?scene=" + id}});
  call.response.set_header("Location", "/scenes/" + id);
  call.response.set_header("Cache-Control", "no-store");
}

}  // namespace raytracer
