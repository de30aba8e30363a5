#include "tests/process/server_process.h"

#include <fmt/format.h>

#include <csignal>
#include <regex>
#include <stdexcept>

#include "tests/process/patience.h"

namespace raytracer::test {
namespace {

Command server_command(std::vector<std::string> flags,
                       std::map<std::string, std::string> environment) {
  flags.insert(flags.begin(), {"--port", "0"});
  return {RAYTRACER_SERVER_PATH, std::move(flags), "", std::move(environment)};
}

}  // namespace

ServerProcess::ServerProcess(std::vector<std::string> flags,
                             std::map<std::string, std::string> environment)
    : process_(server_command(std::move(flags), std::move(environment))) {
  static const std::regex greeting(R"(listening on (http://\S+:(\d+))\n)");
  const bool heard = eventually([&] {
    std::smatch match;
    const std::string said = process_.out();
    if (!std::regex_search(said, match, greeting)) return process_.wait({}).has_value();
    url_ = match[1];
    port_ = std::stoi(match[2]);
    return true;
  });
  if (!heard || url_.empty())
    throw std::runtime_error(
        fmt::format("the server does not listen; it said:\n{}{}", process_.out(), process_.err()));
}

httplib::Client ServerProcess::client() const {
  const auto limit =
      std::chrono::duration_cast<std::chrono::seconds>(patience(std::chrono::milliseconds(30'000)));
  // httplib may write to a connection that the server has closed, which is to be an error code.
  std::signal(SIGPIPE, SIG_IGN);
  httplib::Client client("127.0.0.1", port_);
  client.set_connection_timeout(limit.count());
  client.set_read_timeout(limit.count());
  client.set_write_timeout(limit.count());
  client.set_tcp_nodelay(true);  // or a body waits for the server's delayed acknowledgement
  return client;
}

}  // namespace raytracer::test
