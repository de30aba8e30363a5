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

class Departures {
 public:
  Departures();
  ~Departures();
  Departures(const Departures&) = delete;
  Departures& operator=(const Departures&) = delete;

  /// Looks at a connection for as long as it lives, and calls `left` once if the client has left:
  /// soon, on another thread, and never after its own life.
  class Watch {
   public:
    Watch(Departures& departures, ConnectionEnds connection, std::function<void()> left);
    ~Watch();
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

   private:
    friend class Departures;
    void look();

    Departures& departures_;
    const ConnectionEnds connection_;
    std::optional<int> socket_;   ///< looked for at the first look; -1: not there any more
    std::function<void()> left_;  ///< null once called
  };

 private:
  void look();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Watch*> watched_;
  bool is_idle_ = false;  ///< waits for the first to watch
  bool closing_ = false;
  std::thread thread_;
};

}  // namespace raytracer
