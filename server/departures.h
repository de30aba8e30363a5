// Tells when clients have left: one thread looks at the connections of all requests that render or
// wait, some twenty times a second.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

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
    Watch(Departures& departures, int socket, std::function<void()> left);
    ~Watch();
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

   private:
    friend class Departures;
    Departures& departures_;
    int socket_;
    std::function<void()> left_;  ///< null once called
  };

 private:
  void look();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Watch*> watched_;
  bool closing_ = false;
  std::thread thread_;
};

}  // namespace raytracer
