#include "engine/parallel/worker_pool.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <numeric>

#include "engine/parallel/processors.h"

namespace raytracer {
namespace {

/// Returns when the condition is true, or soon: a render is several batches in a row, the last task
/// of one may end any moment, and to wake a thread takes as long as a small render.
template <typename Condition>
void watch_for(const Condition& is_true) {
  constexpr std::chrono::microseconds longest{50};
  const auto end = std::chrono::steady_clock::now() + longest;
  while (!is_true() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
}

}  // namespace

/// One caller's tasks. Guarded by the pool's mutex, but for `task`, `stop` and `is_finished`.
struct WorkerPool::Batch {
  Batch(std::size_t task_count, const std::function<void(std::size_t)>& task_to_run,
        const std::atomic<bool>& stop_flag)
      : count(task_count), task(task_to_run), stop(stop_flag) {}

  const std::size_t count;
  const std::function<void(std::size_t)>& task;
  const std::atomic<bool>& stop;
  std::size_t begun = 0;
  std::size_t running = 0;
  double had_s = 0;    ///< where the batch stands in virtual time: its begin and what it was given
  double ended_s = 0;  ///< what its ended tasks took
  std::exception_ptr failure{};
  std::atomic<bool> is_finished{false};
  std::condition_variable finished{};

  double mean_task_s() const {
    const std::size_t ended = begun - running;
    return ended == 0 ? 0 : ended_s / static_cast<double>(ended);
  }
  bool has_more() const { return begun < count && !failure && !stop; }
  bool has_ended() const { return running == 0 && !has_more(); }
  void tell_end() {
    is_finished = true;
    finished.notify_all();
  }
};

WorkerPool::WorkerPool(std::size_t thread_count, Priority priority)
    : thread_count_(std::max<std::size_t>(thread_count, 1)), priority_(priority) {
  busy_processors_.reserve(thread_count_);  // nothing is allocated where a task begins
  threads_.reserve(thread_count_);
  try {
    while (threads_.size() < thread_count_)
      threads_.emplace_back([this] {
        if (priority_ == Priority::background) run_in_background();
        work();
      });
  } catch (...) {  // the system grants no more threads
    close();
    throw;
  }
}

WorkerPool::~WorkerPool() { close(); }

void WorkerPool::close() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  work_arrived_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void WorkerPool::run(std::size_t count, const std::function<void(std::size_t)>& task,
                     const std::atomic<bool>& stop) {
  const auto batch = std::make_shared<Batch>(count, task, stop);
  std::unique_lock lock(mutex_);
  if (!batch->has_more()) return;
  batch->had_s = virtual_time_s_;
  batches_.push_back(batch);
  ++arrivals_;
  while (priority_ == Priority::usual && batches_.size() == 1 && batches_.front() == batch &&
         has_turn())
    run_next_task(lock, batch);
  if (needs_another()) work_arrived_.notify_one();
  if (!batch->has_ended()) {
    lock.unlock();
    watch_for([&] { return batch->is_finished.load(); });
    lock.lock();
  }
  batch->finished.wait(lock, [&] { return batch->has_ended(); });
  // A batch that was stopped may still stand in the queue; its task must not outlive this call.
  std::erase(batches_, batch);
  if (batch->failure) std::rethrow_exception(batch->failure);
}

std::shared_ptr<WorkerPool::Batch> WorkerPool::next_batch() const {
  return *std::min_element(batches_.begin(), batches_.end(),
                           [](const auto& a, const auto& b) { return a->had_s < b->had_s; });
}

void WorkerPool::run_next_task(std::unique_lock<std::mutex>& lock,
                               const std::shared_ptr<Batch>& batch) {
  if (!batch->has_more()) {
    std::erase(batches_, batch);
    if (batch->running == 0) batch->tell_end();
    return;
  }
  const double expected_s = batch->mean_task_s();
  virtual_time_s_ = std::max(virtual_time_s_, batch->had_s);
  batch->had_s += expected_s;
  const std::size_t index = batch->begun++;
  ++batch->running;
  ++running_;
  const int processor = current_processor();
  busy_processors_.push_back(processor);
  if (!batch->has_more()) std::erase(batches_, batch);
  const bool calls_another = needs_another();

  lock.unlock();
  if (calls_another) work_arrived_.notify_one();  // who takes a task wakes the next
  std::exception_ptr failure;
  const auto began = Clock::now();
  try {
    batch->task(index);
  } catch (...) {
    failure = std::current_exception();
  }
  const std::chrono::duration<double> took = Clock::now() - began;
  lock.lock();
  batch->had_s += took.count() - expected_s;
  batch->ended_s += took.count();
  if (failure) batch->failure = failure;
  --batch->running;
  --running_;
  busy_processors_.erase(std::find(busy_processors_.begin(), busy_processors_.end(), processor));
  if (batch->has_ended()) batch->tell_end();
}

bool WorkerPool::needs_another() {
  const auto waiting = std::accumulate(
      batches_.begin(), batches_.end(), std::size_t{0},
      [](std::size_t sum, const auto& batch) { return sum + batch->count - batch->begun; });
  const std::size_t wanted = std::min(waiting, thread_count_ - running_);
  if (looking_ + coming_ >= wanted || sleeping_ == coming_) return false;
  ++coming_;
  return true;
}

void WorkerPool::sleep(std::unique_lock<std::mutex>& lock) {
  ++sleeping_;
  work_arrived_.wait(lock);
  --sleeping_;
  if (coming_ > 0) --coming_;
}

void WorkerPool::spread_out(std::unique_lock<std::mutex>& lock, std::vector<int>& busy) const {
  const int here = current_processor();
  if (here < 0 || std::count(busy_processors_.begin(), busy_processors_.end(), here) == 0) return;
  busy = busy_processors_;
  lock.unlock();
  leave_processors(busy);
  lock.lock();
}

void WorkerPool::work() {
  std::vector<int> busy;
  busy.reserve(thread_count_);
  std::unique_lock lock(mutex_);
  for (;;) {
    const bool was_idle = !has_turn();
    if (!closing_ && batches_.empty()) {
      const std::uint64_t seen = arrivals_;
      ++looking_;
      lock.unlock();
      watch_for([&] { return arrivals_ != seen; });
      lock.lock();
      --looking_;
    }
    while (!has_turn() && !closing_) sleep(lock);
    if (closing_) return;
    if (was_idle) spread_out(lock, busy);
    if (has_turn()) run_next_task(lock, next_batch());
  }
}

}  // namespace raytracer
