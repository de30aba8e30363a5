#include "client/with_server.h"

#include <optional>
#include <string>

#include "client/failure.h"
#include "client/interrupts.h"
#include "client/private_daemon.h"

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
    const std::string obituary = daemon ? daemon->obituary() : "";
    if (obituary.empty()) throw;
    throw ServerError("the private server failed: " + obituary);
  }
}

}  // namespace raytracer::client
