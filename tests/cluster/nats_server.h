// A nats-server of a test's own, on a port that it chose, with its store in a temporary folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/process/program.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {

class NatsServer {
 public:
  /// Where it is installed; empty if it is not.
  static std::filesystem::path program();

  /// Returns when it takes connections. Throws std::runtime_error with what it said if it does not.
  NatsServer();

  const std::string& url() const { return url_; }

  /// The bytes of all messages that it has sent so far, by its own count.
  std::uint64_t sent_bytes() const { return monitored("out_bytes"); }
  /// How many messages it was sent so far.
  std::uint64_t received_messages() const { return monitored("in_msgs"); }

  void signal(int number) const { process_->signal(number); }
  /// Ends it at once, as a crash would.
  void kill();
  /// Starts it again: the same port, the same store.
  void start(const std::vector<std::string>& flags = {"--jetstream"});

  /// The URL for somebody who has to say who it is.
  std::string url_of(const std::string& user, const std::string& password) const;

 private:
  /// The port that it named after `greeting` when it started.
  int port_after(const std::string& greeting) const;
  std::uint64_t monitored(const std::string& counter) const;

  static constexpr int any_port = -1;

  TemporaryFolder store_;
  int port_ = any_port;
  int monitor_port_ = any_port;
  std::string url_;
  std::optional<Process> process_;
};

}  // namespace raytracer::test
