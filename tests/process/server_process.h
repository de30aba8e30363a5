// A raytracer-server of a test's own, on a port that is free.
#pragma once

#include <httplib.h>

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/process/program.h"

namespace raytracer::test {

class ServerProcess {
 public:
  /// Returns when it listens. `flags` come after "--port 0". Throws std::runtime_error with what it
  /// said if it does not.
  explicit ServerProcess(std::vector<std::string> flags = {},
                         std::map<std::string, std::string> environment = {});

  const std::string& url() const { return url_; }  ///< "http://127.0.0.1:40123"
  int port() const { return port_; }

  /// A connection that may be used by one thread and waits for answers up to patience(30 s).
  httplib::Client client() const;

  pid_t id() const { return process_.id(); }
  void signal(int number) const { process_.signal(number); }
  /// Its exit status; nothing if it does not end within patience(limit).
  std::optional<int> wait(std::chrono::milliseconds limit = std::chrono::milliseconds(10'000)) {
    return process_.wait(limit);
  }
  /// Standard error so far: a line per request.
  std::string log() const { return process_.err(); }
  /// Standard output so far.
  std::string out() const { return process_.out(); }

 private:
  Process process_;
  std::string url_;
  int port_ = 0;
};

}  // namespace raytracer::test
