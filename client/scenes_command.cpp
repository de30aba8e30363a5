// raytracer scenes: the shipped scenes in two columns.
#include <fmt/format.h>

#include <algorithm>

#include "client/commands.h"
#include "client/with_server.h"

namespace raytracer::client {

void list_scenes(const ServerChoice& server) {
  std::vector<ShippedScene> scenes;
  with_server(server, [&](Api& api) { scenes = api.scenes(); });
  std::size_t widest = 0;
  for (const ShippedScene& scene : scenes) widest = std::max(widest, scene.name.size());
  for (const ShippedScene& scene : scenes)
    fmt::print("{:<{}}  {}\n", scene.name, widest, scene.description);
}

}  // namespace raytracer::client
