#include "tests/cluster/balancer.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>

#include "tests/process/patience.h"

namespace raytracer::test {
namespace {

/// One that nobody listens on now.
int free_port() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t length = sizeof address;
  auto* const any_address = reinterpret_cast<sockaddr*>(&address);
  const bool is_bound =
      ::bind(socket, any_address, length) == 0 && ::getsockname(socket, any_address, &length) == 0;
  ::close(socket);
  if (!is_bound) throw std::runtime_error("there is no free port");
  return ntohs(address.sin_port);
}

}  // namespace

bool has_balancer() { return std::filesystem::exists(RAYTRACER_HAPROXY_PATH); }

Balancer::Balancer(const std::vector<std::unique_ptr<ServerProcess>>& fronts) {
  constexpr int tries = 5;  // somebody else may take the port first
  for (int i = 0; i < tries; ++i) {
    start(fronts);
    const bool answers = eventually([&] {
      return process_->wait({}).has_value() ||
             client().Get("/healthz").error() == httplib::Error::Success;
    });
    if (answers && !process_->wait({})) return;
  }
  throw std::runtime_error(fmt::format("HAProxy does not start; it said:\n{}", log()));
}

void Balancer::start(const std::vector<std::unique_ptr<ServerProcess>>& fronts) {
  port_ = free_port();
  std::map<std::string, std::string> environment{{"BIND", fmt::format("127.0.0.1:{}", port_)}};
  for (std::size_t i = 0; i < fronts.size(); ++i)
    environment[fmt::format("FRONT_{}", i + 1)] = fmt::format("127.0.0.1:{}", fronts[i]->port());
  process_ = std::make_unique<Process>(
      Command{RAYTRACER_HAPROXY_PATH,
              {"-db", "-f", std::string(RAYTRACER_SOURCE_DIR) + "/server/deploy/haproxy.cfg"},
              "",
              environment});
}

httplib::Client Balancer::client() const {
  const auto limit =
      std::chrono::duration_cast<std::chrono::seconds>(patience(std::chrono::milliseconds(30'000)));
  httplib::Client client("127.0.0.1", port_);
  client.set_keep_alive(true);
  client.set_tcp_nodelay(true);
  client.set_read_timeout(limit.count());
  return client;
}

}  // namespace raytracer::test
