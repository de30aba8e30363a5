// Threads that trace the tiles of several requests at once, with the same time for each request.
//
// In turn by tasks, a small render beside a huge one would wait for one of its long tiles before
// each of its own short ones. Here a batch's tasks are paid for in time, and the batch that has had
// least of it comes next; one that arrives begins where the one served last stands, so that it need
// not wait for what others had before, nor can a stream of small batches starve a long one. This is
// start-time fair queueing: Goyal, Vin, Cheng, SIGCOMM 1996. The length of a task that runs is not
// known: until it ends it counts as its batch's mean. Nothing interrupts a task, so a batch waits
// at most for those that run when it arrives.
//
// A caller whose batch is the only one works on it too, in the place of one of the threads: to wake
// one up takes as long as a small picture. Not in the background: the caller's priority is the
// usual.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace raytracer {

enum class Priority {
  usual,
  background,  ///< whatever else runs on this machine comes first
};

/// A fixed number of threads; every member function may be called from any thread.
class WorkerPool {
 public:
  /// Starts `thread_count` (at least 1) threads.
  explicit WorkerPool(std::size_t thread_count, Priority priority = Priority::usual);
  /// Not while run() is under way.
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  std::size_t thread_count() const { return thread_count_; }

  /// Calls task(0) ... task(count - 1), each once, on the pool's threads or this one, at most
  /// thread_count() at a time, and returns when all have returned. Batches of different callers
  /// share the threads by time. Once `stop` is set no further task begins. An exception of a task
  /// stops the batch and is thrown here. Not to be called from a task.
  void run(std::size_t count, const std::function<void(std::size_t)>& task,
           const std::atomic<bool>& stop = never);

 private:
  static inline const std::atomic<bool> never{false};
  struct Batch;
  using Clock = std::chrono::steady_clock;

  void work();
  /// Has the threads end, and waits for them.
  void close();
  /// The batch whose turn it is.
  std::shared_ptr<Batch> next_batch() const;
  bool has_turn() const { return !batches_.empty() && running_ < thread_count_; }
  /// Whether a task waits that no thread is on its way to, and one sleeps. It then counts as
  /// coming: the caller wakes it up, without the mutex if it can.
  bool needs_another();
  /// Until woken up, with `lock` released meanwhile.
  void sleep(std::unique_lock<std::mutex>& lock);
  /// Runs the batch's next task, if it has one, with `lock` released meanwhile.
  void run_next_task(std::unique_lock<std::mutex>& lock, const std::shared_ptr<Batch>& batch);
  /// Moves this thread off a processor on which a task runs already, with `lock` released
  /// meanwhile; `busy` is memory for that.
  void spread_out(std::unique_lock<std::mutex>& lock, std::vector<int>& busy) const;

  const std::size_t thread_count_;
  const Priority priority_;
  std::mutex mutex_;
  std::condition_variable work_arrived_;
  std::vector<std::shared_ptr<Batch>> batches_;  ///< those with tasks not yet begun
  std::size_t running_ = 0;                      ///< tasks, of all batches
  std::vector<int> busy_processors_;             ///< those that the tasks began on, -1 if unknown
  double virtual_time_s_ = 0;                    ///< where the batch stood that was served last
  std::atomic<std::uint64_t> arrivals_{0};       ///< batches so far
  std::size_t looking_ = 0;                      ///< threads that look out for a batch
  std::size_t sleeping_ = 0;                     ///< those that sleep, ...
  std::size_t coming_ = 0;                       ///< ... and of them those that are being woken up
  bool closing_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace raytracer
