// Tells when clients have left: one thread looks at the connections of all requests that render or
// wait, some twenty times a second. A request that is answered before the next look costs it
// nothing.
#pragma once

#include <httplib.h>

#include <condition_variable>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace raytracer {

/// A thread that looks after the connections of requests that wait.
class DisconnectWatch {
 public:
  DisconnectWatch();
  ~DisconnectWatch();
  DisconnectWatch(const DisconnectWatch&) = delete;
  DisconnectWatch& operator=(const DisconnectWatch&) = delete;

  using Registration = std::shared_ptr<const void>;

  /// Looks at a request's connection for as long as somebody holds what this returns, and calls
  /// `on_disconnect` once if the client has left: soon, on another thread, and never afterwards.
  Registration watch(const httplib::Request& request, std::function<void()> on_disconnect);

 private:
  struct Client {
    const httplib::Request& request;
    std::function<void()> on_disconnect;  ///< null once called
    std::optional<int> socket{};          ///< looked for at the first look
  };

  void poll();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<Client> clients_;
  bool is_idle_ = false;  ///< waits for the first client, who is to wake it
  bool closing_ = false;
  std::thread thread_;
};

}  // namespace raytracer
