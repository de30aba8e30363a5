// raytracer validate: what the server says about a scene, without rendering it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "client/command_line.h"
#include "client/commands.h"
#include "client/with_server.h"

namespace raytracer::client {
namespace {

void validate_frames(const SceneChoice& choice, const ServerChoice& server) {
  const NextFrame next_frame = read_frames(choice, {});
  std::optional<SceneText> frame = next_frame();  // before a server is started for it
  int count = 0;
  with_server(server, [&](Api& api) {
    for (; frame; frame = next_frame(), ++count) api.validate(*frame);
  });
  fmt::print("{}: valid{}\n", choice.name, count > 1 ? fmt::format(", {} frames", count) : "");
}

void validate(const SceneChoice& choice, const ServerChoice& server) {
  if (has_frames(choice)) return validate_frames(choice, server);
  const SceneText scene = with_scene(
      choice, {}, server, [](Api& api, const SceneText& checked) { api.validate(checked); });
  fmt::print("{}: valid\n", scene.label);
}

}  // namespace

void add_validate(CLI::App& app, const ServerChoice& server) {
  const auto choice = std::make_shared<SceneChoice>();
  add_scene_command(app, "validate", "Check a scene or a file's frames without rendering", *choice)
      .callback([choice, &server] { validate(*choice, server); });
}

}  // namespace raytracer::client
