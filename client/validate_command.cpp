// raytracer validate: what the server says about a scene, without rendering it.
#include <fmt/format.h>

#include "client/commands.h"
#include "client/scene_errors.h"
#include "client/with_server.h"

namespace raytracer::client {

void validate(const ValidateArguments& arguments, const ServerChoice& server) {
  std::optional<SceneSource> scene = read_scene_file(arguments.scene);
  with_server(server, [&](Api& api) {
    if (!scene) scene = fetch_shipped_scene(arguments.scene, api);
    try {
      api.validate(scene->text);
    } catch (const Refused& refused) {
      throw explain(refused, *scene, {});
    }
  });
  fmt::print("{}: valid\n", scene->label);
}

}  // namespace raytracer::client
