// HAProxy with server/deploy/haproxy.cfg before fronts of a test's own, on a port that is free.
#pragma once

#include <httplib.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/process/server_process.h"

namespace raytracer::test {

/// Whether HAProxy is installed.
bool has_balancer();

class Balancer {
 public:
  /// Returns when it passes requests on. At most four fronts, which outlive it. Throws
  /// std::runtime_error with what it said if it does not.
  explicit Balancer(const std::vector<std::unique_ptr<ServerProcess>>& fronts);

  /// A kept-alive connection that may be used by one thread and waits for answers up to
  /// patience(30 s).
  httplib::Client client() const;
  /// What it said so far.
  std::string log() const { return process_->err(); }

 private:
  void start(const std::vector<std::unique_ptr<ServerProcess>>& fronts);

  int port_ = 0;
  std::unique_ptr<Process> process_;
};

}  // namespace raytracer::test
