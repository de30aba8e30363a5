#include "client/with_server.h"

#include <optional>
#include <string>

#include "client/failure.h"
#include "client/interrupts.h"
#include "client/private_daemon.h"
#include "client/scene_errors.h"

namespace raytracer::client {

void with_server(const ServerChoice& choice, const std::function<void(Api&)>& use) {
  Interrupts interrupts;
  std::optional<PrivateDaemon> daemon;
  if (!choice.url) daemon.emplace(interrupts);
  Api api(choice.url ? *choice.url : read_server_url(daemon->url(), "the private server's address"),
          choice.token, interrupts);
  try {
    use(api);
  } catch (const ServerError&) {
    const std::string exit_report = daemon ? daemon->exit_report() : "";
    if (exit_report.empty()) throw;
    throw ServerError("the private server failed: " + exit_report);
  }
}

SceneSource with_scene(const std::string& name, const Overrides& overrides,
                       const ServerChoice& choice,
                       const std::function<void(Api&, const SceneSource&)>& use) {
  std::optional<SceneSource> scene = read_scene_file(name);
  with_server(choice, [&](Api& api) {
    if (!scene) scene = fetch_shipped_scene(name, api);
    try {
      use(api, *scene);
    } catch (const Refused& refused) {
      throw explain(refused, *scene, overrides);
    }
  });
  return *std::move(scene);
}

}  // namespace raytracer::client
