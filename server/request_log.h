// One line on standard error for each request, and the count of those that are not answered yet.
//
// httplib serves a request on one thread from its first handler to its logger, so the thread
// stands for the request in between.
#pragma once

#include <httplib.h>

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace raytracer {

/// Every member function may be called from any thread.
class RequestLog {
 public:
  /// Quiet: notes only, no line per request.
  explicit RequestLog(bool quiet) : quiet_(quiet) {}

  /// The calling thread's request begins; once more changes nothing.
  void begin();

  /// The calling thread's request was answered.
  void end(const httplib::Request& request, const httplib::Response& response);

  /// A line of its own.
  void note(std::string_view text);

  /// True once all that began are answered; false if that takes longer than `timeout`.
  bool wait_until_empty(std::chrono::milliseconds timeout);

 private:
  using Clock = std::chrono::steady_clock;

  const bool quiet_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::thread::id, Clock::time_point> began_;
};

}  // namespace raytracer
