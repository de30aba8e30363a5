// Threads that trace the tiles of several requests at once, a tile of each in turn.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace raytracer {

/// A fixed number of threads; every member function may be called from any thread.
class WorkerPool {
 public:
  /// Starts `thread_count` (at least 1) threads.
  explicit WorkerPool(std::size_t thread_count);
  /// Waits for the batches that run.
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  std::size_t thread_count() const { return threads_.size(); }

  /// Calls task(0) ... task(count - 1), each once, on the pool's threads, and returns when all
  /// have returned. Batches of different callers take turns task by task. Once `stop` is set no
  /// further task begins. An exception of a task stops the batch and is thrown here.
  /// Not to be called from a task.
  void run(std::size_t count, const std::function<void(std::size_t)>& task,
           const std::atomic<bool>& stop);

 private:
  struct Batch;
  void work();
  /// Returns when a batch has arrived after the one numbered `seen`, or soon: a render is several
  /// batches in a row, and waking a thread takes as long as a small one.
  void watch_for_arrival(std::uint64_t seen) const;

  std::mutex mutex_;
  std::condition_variable work_arrived_;
  std::deque<std::shared_ptr<Batch>> batches_;  ///< those with tasks not yet begun, in turn
  std::atomic<std::uint64_t> arrivals_{0};      ///< batches so far
  bool closing_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace raytracer
