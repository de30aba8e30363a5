#include "client/with_server.h"

#include <optional>

#include "client/failure.h"
#include "client/interrupts.h"
#include "client/private_daemon.h"

namespace raytracer::client {

namespace {

using Daemon = std::optional<PrivateDaemon>;

/// Begins to start one where no server is named.
void start_daemon(const ServerChoice& choice, Daemon& daemon) {
  if (!choice.url) daemon.emplace();
}

void use_server(const ServerChoice& choice, Daemon& daemon, const std::function<void(Api&)>& use) {
  Interrupts interrupts;
  Api api(choice.url ? *choice.url : read_server_url(daemon->wait_until_listening(interrupts)),
          choice.token.value_or(""), interrupts);
  try {
    use(api);
  } catch (const ServerError&) {
    const std::string exit_report = daemon ? daemon->exit_report() : "";
    if (exit_report.empty()) throw;
    throw ServerError("the private server failed: " + exit_report);
  }
}

}  // namespace

void with_server(const ServerChoice& given, const std::function<void(Api&)>& use) {
  const ServerChoice choice = with_variables(given);
  Daemon daemon;
  start_daemon(choice, daemon);
  use_server(choice, daemon, use);
}

SceneText with_scene(const SceneChoice& scene, const Overrides& overrides,
                     const ServerChoice& given,
                     const std::function<void(Api&, const SceneText&)>& use) {
  const ServerChoice server = with_variables(given);
  Daemon daemon;
  start_daemon(server, daemon);
  std::optional<SceneText> text = read_scene_file(scene, overrides);
  use_server(server, daemon, [&](Api& api) {
    if (!text) text = api.shipped_scene(scene.name);
    use(api, *text);
  });
  return *std::move(text);
}

}  // namespace raytracer::client
