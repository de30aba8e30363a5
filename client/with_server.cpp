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

SceneText with_scene(const std::string& name, const ServerChoice& choice,
                     const std::function<void(Api&, const SceneText&)>& use) {
  std::optional<SceneText> scene = read_scene_file(name);
  with_server(choice, [&](Api& api) {
    if (!scene) scene = api.shipped_scene(name);
    use(api, *scene);
  });
  return *std::move(scene);
}

}  // namespace raytracer::client
