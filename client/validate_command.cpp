// raytracer validate: what the server says about a scene, without rendering it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "client/command_line.h"
#include "client/commands.h"
#include "client/with_server.h"

namespace raytracer::client {

void add_validate(CLI::App& app, const ServerChoice& server) {
  const auto choice = std::make_shared<SceneChoice>();
  add_scene_command(app, "validate", "Check a scene without rendering it", *choice)
      .callback([choice, &server] {
        const SceneText scene = with_scene(
            *choice, {}, server, [](Api& api, const SceneText& checked) { api.validate(checked); });
        fmt::print("{}: valid\n", scene.label);
      });
}

}  // namespace raytracer::client
