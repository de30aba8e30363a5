// One line on standard error for each request, and the count of those that are not answered yet.
//
// A line is fields that a program can read, name=value, after the time: the request's id, method
// and target, status, duration, length, client. Neither bodies nor header fields are among them.
//
// httplib serves a request on one thread from its first handler to its logger, so the thread
// stands for the request in between.
#pragma once

#include <httplib.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
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
  explicit RequestLog(bool quiet);

  /// The calling thread's request begins; once more changes nothing. Returns its id: what its
  /// X-Request-Id says if that is short and plain, otherwise one that no other request has.
  std::string begin(const httplib::Request& request);

  /// The calling thread's request was answered. Returns the seconds that it took.
  double end(const httplib::Request& request, const httplib::Response& response);

  /// A line of its own; it names the calling thread's request if there is one.
  void note(std::string_view text);

  /// True once all that began are answered; false if that takes longer than `timeout`.
  bool wait_until_empty(std::chrono::milliseconds timeout);

 private:
  using Clock = std::chrono::steady_clock;
  struct Open {
    std::string id;
    Clock::time_point began;
  };

  const bool quiet_;
  const std::string id_prefix_;  ///< another one each time that the server starts
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::thread::id, Open> open_;
  std::uint64_t count_ = 0;
};

}  // namespace raytracer
