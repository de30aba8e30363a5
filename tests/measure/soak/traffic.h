// Mixed traffic on a server: everything that clients do, well-meaning, careless and hostile.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/process/server_process.h"

namespace raytracer::test {

/// How often each status was answered; 0: no answer.
using StatusCounts = std::map<int, std::uint64_t>;

/// Clients that go about their business, each at its own pace, for as long as this lives.
class Traffic {
 public:
  /// `round` is another number for each traffic on a server, so that its scenes are new.
  Traffic(const ServerProcess& server, int round);
  /// Waits until every client has done what it was about.
  ~Traffic();
  Traffic(const Traffic&) = delete;
  Traffic& operator=(const Traffic&) = delete;

  StatusCounts counts() const;

 private:
  using Client = void (Traffic::*)(int number);

  void repeat(Client client, std::chrono::milliseconds pause);
  std::string send(const std::string& method, const std::string& target,
                   const std::string& body = "");
  void note(int status);

  void render(int number);
  void keep_a_scene(int number);
  void follow_a_job(int number);
  void cancel_a_job(int number);
  void send_nonsense(int number);
  void leave(int number);

  const ServerProcess& server_;
  const int round_;
  std::atomic<bool> stop_{false};
  mutable std::mutex mutex_;
  StatusCounts counts_;
  std::vector<std::thread> clients_;
};

}  // namespace raytracer::test
