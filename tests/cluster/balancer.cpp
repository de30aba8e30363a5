#include "tests/cluster/balancer.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "tests/process/free_port.h"
#include "tests/process/patience.h"

namespace raytracer::test {
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
