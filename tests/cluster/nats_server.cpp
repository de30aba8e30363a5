#include "tests/cluster/nats_server.h"

#include <fmt/format.h>
#include <httplib.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "tests/process/patience.h"

namespace raytracer::test {
std::filesystem::path NatsServer::program() {
  const char* const path = std::getenv("PATH");
  // Debian has it where only root looks.
  std::istringstream folders(std::string(path != nullptr ? path : "") + ":/usr/sbin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::filesystem::path file = std::filesystem::path(folder) / "nats-server";
    if (::access(file.c_str(), X_OK) == 0) return file;
  }
  return {};
}

NatsServer::NatsServer() {
  start();
  port_ = port_after("client connections on ");
  monitor_port_ = port_after("http monitor on ");
  url_ = fmt::format("nats://127.0.0.1:{}", port_);
}

int NatsServer::port_after(const std::string& greeting) const {
  const std::string said = process_->err();
  const std::regex address(greeting + R"([\d.]+:(\d+))");
  std::smatch match;
  if (!std::regex_search(said, match, address))
    throw std::runtime_error("nats-server does not name its port; it said:\n" + said);
  return std::stoi(match[1]);
}

std::uint64_t NatsServer::monitored(const std::string& counter) const {
  const auto answer = httplib::Client("127.0.0.1", monitor_port_).Get("/varz");
  const std::string name = fmt::format("\"{}\":", counter);
  const std::size_t at = answer ? answer->body.find(name) : std::string::npos;
  if (at == std::string::npos) throw std::runtime_error("nats-server does not say its " + counter);
  return std::stoull(answer->body.substr(at + name.size()));
}

void NatsServer::kill() {
  signal(SIGKILL);
  process_->wait(std::chrono::seconds(10));
  process_.reset();
}

std::string NatsServer::url_of(const std::string& user, const std::string& password) const {
  return fmt::format("nats://{}:{}@127.0.0.1:{}", user, password, port_);
}

void NatsServer::start(const std::vector<std::string>& flags) {
  std::vector<std::string> arguments{"--addr",      "127.0.0.1",
                                     "--port",      std::to_string(port_),
                                     "--store_dir", store_.path().string(),
                                     "--http_port", std::to_string(monitor_port_)};
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  process_.emplace(Command{program(), std::move(arguments)});
  const bool is_ready = eventually([&] {
    return process_->err().find("Server is ready") != std::string::npos ||
           process_->wait({}).has_value();
  });
  if (!is_ready || process_->wait({}))
    throw std::runtime_error("nats-server does not start; it said:\n" + process_->err());
}

}  // namespace raytracer::test
