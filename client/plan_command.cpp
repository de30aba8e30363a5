// raytracer plan: what the server would do with a scene, without rendering all of it.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>

#include "client/command_line.h"
#include "client/commands.h"
#include "client/plan_text.h"
#include "client/terminal.h"
#include "client/with_server.h"

namespace raytracer::client {
namespace {

struct PlanArguments {
  std::string scene;
  bool as_json = false;  ///< the server's own answer
  Overrides overrides;
};

void plan(const PlanArguments& arguments, const ServerChoice& server) {
  std::string json;
  with_scene(arguments.scene, server, [&](Api& api, const SceneText& scene) {
    json = api.plan(scene, arguments.overrides);
  });
  constexpr int most_columns = 100;  // longer lines are hard to read
  const int columns = std::min(terminal_size(STDOUT_FILENO).columns, most_columns);
  fmt::print("{}", arguments.as_json ? json : plan_text(json, columns));
}

}  // namespace

void add_plan(CLI::App& app, const ServerChoice& server) {
  const auto arguments = std::make_shared<PlanArguments>();
  CLI::App& command = add_scene_command(
      app, "plan", "Show the plan and its predicted time and error", arguments->scene);
  command.add_flag("--json", arguments->as_json, "Print the plan as JSON");
  add_accuracy_options(command, arguments->overrides);
  add_picture_options(command, arguments->overrides);
  command.callback([arguments, &server] { plan(*arguments, server); });
}

}  // namespace raytracer::client
