// raytracer-server: configuration, services, routes, listen.
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <variant>

#include "engine/engine.h"
#include "server/config.h"
#include "server/listener.h"
#include "server/routes.h"
#include "server/services.h"
#include "server/shutdown.h"

namespace {

using namespace raytracer;

/// Standard streams that are closed: the next file or socket would take their numbers, and with
/// them what is said there. What uses them fails as before. As in the client's main, with which
/// this program shares no code.
void hold_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) == -1)
      ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

int serve(const Config& config) {
  block_signals();
  Services services(config);
  const RouteTable routes = make_routes(services);
  Listener listener(services.config, routes, services.log, services.metrics);
  const std::string url = listener.bind();
  const Shutdown shutdown(services, listener);
  std::printf("listening on %s\n", url.c_str());
  std::fflush(stdout);
  if (listener.run()) return EXIT_SUCCESS;
  std::fputs("raytracer-server: the listening socket failed\n", stderr);
  return EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) try {
  hold_closed_streams();
  const auto outcome = read_config(argc, argv);
  if (const auto* printout = std::get_if<std::string>(&outcome)) {
    std::fputs(printout->c_str(), stdout);
    return EXIT_SUCCESS;
  }
  return serve(std::get<Config>(outcome));
} catch (const std::exception& error) {
  std::fprintf(stderr, "raytracer-server: %s\n", error.what());
  return EXIT_FAILURE;
}
