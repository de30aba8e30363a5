// A thread for each task, so that none waits for another that is silent or stands in a queue.
//
// httplib serves a connection on one thread from its first request to its end, and a silent one
// holds its thread for seconds. With a fixed number of threads as many silent connections would
// keep everybody waiting, /healthz among them. Here a thread is started whenever a task finds none
// idle, and ends when it has been idle for a while. Jobs are run alike.
#pragma once

#include <httplib.h>

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <vector>

namespace raytracer {

/// Also what httplib hands its connections to. shutdown() comes before the end.
class ThreadPerTask : public httplib::TaskQueue {
 public:
  explicit ThreadPerTask(std::size_t most) : most_(most) {}

  /// Beyond `most` tasks, or where the system has no more threads, the task waits for another to
  /// end. Throws std::system_error, and the task is not run, if there is not a single thread.
  void enqueue(std::function<void()> task) override;

  /// Waits for the tasks that run, and runs those that wait.
  void shutdown() override;

 private:
  void start_thread();
  void work();

  const std::size_t most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  std::unordered_map<std::thread::id, std::thread> threads_;
  std::vector<std::thread> ended_;  ///< to be joined
  std::size_t idle_ = 0;
  bool closing_ = false;
};

}  // namespace raytracer
