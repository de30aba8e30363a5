#include "client/with_server.h"

#include <optional>

#include "client/failure.h"
#include "client/interrupts.h"
#include "client/private_daemon.h"

namespace raytracer::client {

void with_server(const ServerChoice& choice, const std::function<void(Api&)>& use) {
  Interrupts interrupts;
  std::optional<PrivateDaemon> daemon;
  if (!choice.url) daemon.emplace(interrupts);
  Api api(choice.url ? *choice.url : read_server_url(daemon->url()), choice.token, interrupts);
  try {
    use(api);
  } catch (const ServerError&) {
    const std::string exit_report = daemon ? daemon->exit_report() : "";
    if (exit_report.empty()) throw;
    throw ServerError("the private server failed: " + exit_report);
  }
}

SceneText with_scene(const SceneChoice& scene, const Overrides& overrides,
                     const ServerChoice& server,
                     const std::function<void(Api&, const SceneText&)>& use) {
  std::optional<SceneText> text = read_scene_file(scene, overrides);
  with_server(server, [&](Api& api) {
    if (!text) text = api.shipped_scene(scene.name);
    use(api, *text);
  });
  return *std::move(text);
}

}  // namespace raytracer::client
