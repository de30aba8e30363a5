// raytracer validate: what the server says about a scene, without rendering it.
#include <fmt/format.h>

#include "client/commands.h"
#include "client/with_server.h"

namespace raytracer::client {

void validate(const ValidateArguments& arguments, const ServerChoice& server) {
  const SceneSource scene =
      with_scene(arguments.scene, {}, server,
                 [](Api& api, const SceneSource& checked) { api.validate(checked.text); });
  fmt::print("{}: valid\n", scene.label);
}

}  // namespace raytracer::client
