// raytracer plan: what the server would do with a scene, without rendering all of it.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "client/commands.h"
#include "client/plan_text.h"
#include "client/terminal.h"
#include "client/with_server.h"

namespace raytracer::client {

void plan(const PlanArguments& arguments, const ServerChoice& server) {
  std::string json;
  with_scene(arguments.scene, arguments.overrides, server, [&](Api& api, const SceneSource& scene) {
    json = api.plan(scene.text, arguments.overrides);
  });
  if (arguments.as_json) {
    fmt::print("{}", json);
    return;
  }
  constexpr int most_columns = 100;  // longer lines are hard to read
  const int columns = std::min(terminal_size(STDOUT_FILENO).columns, most_columns);
  fmt::print("{}", plan_text(json, columns));
}

}  // namespace raytracer::client
