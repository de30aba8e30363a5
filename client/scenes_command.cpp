// raytracer scenes: the shipped scenes in two columns.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <vector>

#include "client/command_line.h"
#include "client/commands.h"
#include "client/with_server.h"

namespace raytracer::client {

void add_scenes(CLI::App& app, const ServerChoice& server) {
  add_command(app, "scenes", "List the shipped scenes").callback([&server] {
    std::vector<ShippedScene> scenes;
    with_server(server, [&](Api& api) { scenes = api.scenes(); });
    std::size_t widest = 0;
    for (const ShippedScene& scene : scenes) widest = std::max(widest, scene.name.size());
    for (const ShippedScene& scene : scenes)
      fmt::print("{:<{}}  {}\n", scene.name, widest, scene.description);
  });
}

}  // namespace raytracer::client
