// Ends the renders of clients that have left: one thread looks at the connections of all requests
// that render or wait, some twenty times a second.
#pragma once

#include <atomic>
#include <condition_variable>
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

  /// Looks at a connection for as long as it lives.
  class Watch {
   public:
    Watch(Departures& departures, int socket, std::atomic<bool>& stop);
    ~Watch();
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

   private:
    friend class Departures;
    Departures& departures_;
    int socket_;
    std::atomic<bool>& stop_;  ///< set when the client has left
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
