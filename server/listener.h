// The HTTP server: httplib with its traps closed, between the route table and the network.
//
// httplib reads requests and writes answers; which handler answers is the route table's business.
// Each connection has a thread of its own (thread_per_task.h), so that /healthz waits for
// nobody. Tracing has its own threads.
#pragma once

#include <httplib.h>

#include <atomic>
#include <string>

#include "server/config.h"
#include "server/metrics.h"
#include "server/request_log.h"
#include "server/route_table.h"

namespace raytracer {

/// Answers requests from bind() and run() to stop(), each with a line in the log and its metrics.
class Listener {
 public:
  /// All four must outlive the listener.
  Listener(const Config& config, const RouteTable& routes, RequestLog& log, Metrics& metrics);

  /// Takes the address; connections are accepted from here on and served by run(). Returns the
  /// URL with the real port. Throws ConfigError if the address cannot be had.
  std::string bind();

  /// Serves until stop(); false if it ended by itself.
  bool run();

  /// Ends run() and every connection: wait for the answers that matter before.
  void stop();

 private:
  void set_options();
  void set_validation();
  void set_dispatch();
  void set_refusals();
  void set_completion();
  /// Whether the step does not throw; what it throws is the answer.
  template <typename Step>
  bool succeeds(Call& call, const Step& step);
  bool is_valid(const httplib::Request& request, httplib::Response& response);
  void dispatch(Call call);
  void complete_fields(const httplib::Request& request, httplib::Response& response);
  void answer_unrouted(const httplib::Request& request, httplib::Response& response);
  void finish(const httplib::Request& request, const httplib::Response& response);

  const Config& config_;
  const RouteTable& routes_;
  RequestLog& log_;
  Metrics& metrics_;
  httplib::Server server_;
  int listening_socket_ = -1;
  int port_ = 0;
  std::atomic<bool> stopping_{false};
  std::atomic<bool> has_ended_{false};  ///< run() has
};

}  // namespace raytracer
