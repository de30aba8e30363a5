// raytracer plan: what the server would do with a scene, without rendering all of it.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "client/commands.h"
#include "client/plan_text.h"
#include "client/scene_errors.h"
#include "client/terminal.h"
#include "client/with_server.h"

namespace raytracer::client {

void plan(const PlanArguments& arguments, const ServerChoice& server) {
  std::optional<SceneSource> scene = read_scene_file(arguments.scene);
  std::string json;
  with_server(server, [&](Api& api) {
    if (!scene) scene = fetch_shipped_scene(arguments.scene, api);
    try {
      json = api.plan(scene->text, arguments.overrides);
    } catch (const Refused& refused) {
      throw explain(refused, *scene, arguments.overrides);
    }
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
