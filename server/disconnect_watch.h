// Tells when clients have left: one thread looks at the connections of all requests that render or
// wait, some twenty times a second. A request that is answered before the next look costs it
// nothing.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "server/connection.h"

namespace raytracer {

class DisconnectWatch {
 public:
  DisconnectWatch();
  ~DisconnectWatch();
  DisconnectWatch(const DisconnectWatch&) = delete;
  DisconnectWatch& operator=(const DisconnectWatch&) = delete;

  /// Looks at a connection for as long as it lives, and calls `on_disconnect` once if the client
  /// has left: soon, on another thread, and never after its own life.
  class Registration {
   public:
    Registration(DisconnectWatch& watch, ConnectionEndpoints connection,
                 std::function<void()> on_disconnect);
    ~Registration();
    Registration(const Registration&) = delete;
    Registration& operator=(const Registration&) = delete;

   private:
    friend class DisconnectWatch;
    void poll();

    DisconnectWatch& watch_;
    const ConnectionEndpoints connection_;
    std::optional<int> socket_;            ///< looked for at the first look; -1: not there any more
    std::function<void()> on_disconnect_;  ///< null once called
  };

 private:
  void poll();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Registration*> registered_;
  bool is_idle_ = false;  ///< waits for the first to watch
  bool closing_ = false;
  std::thread thread_;
};

}  // namespace raytracer
