#include "server/thread_per_task.h"

#include <chrono>
#include <system_error>
#include <utility>

namespace raytracer {

void ThreadPerTask::enqueue(std::function<void()> task) {
  std::vector<std::thread> ended;
  {
    const std::scoped_lock lock(mutex_);
    ended.swap(ended_);
    if (waiting_.size() >= idle_ && threads_.size() < most_) start_thread();
    waiting_.push_back(std::move(task));
  }
  changed_.notify_one();
  for (std::thread& thread : ended) thread.join();
}

/// With the mutex held: the thread does not look before it is among the others.
void ThreadPerTask::start_thread() {
  try {
    std::thread thread([this] { work(); });
    const std::thread::id id = thread.get_id();
    threads_.emplace(id, std::move(thread));
  } catch (const std::system_error&) {
    if (threads_.empty()) throw;
  }
}

void ThreadPerTask::work() {
  constexpr std::chrono::seconds longest_idle{5};
  std::unique_lock lock(mutex_);
  for (;;) {
    ++idle_;
    changed_.wait_for(lock, longest_idle, [this] { return closing_ || !waiting_.empty(); });
    --idle_;
    if (waiting_.empty()) break;
    std::function<void()> task = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    task();
    task = nullptr;  // what it holds may take long to destroy
    lock.lock();
  }
  const auto self = threads_.find(std::this_thread::get_id());
  ended_.push_back(std::move(self->second));
  threads_.erase(self);
  changed_.notify_all();
}

void ThreadPerTask::shutdown() {
  std::unique_lock lock(mutex_);
  closing_ = true;
  changed_.notify_all();
  changed_.wait(lock, [this] { return threads_.empty(); });
  for (std::thread& thread : ended_) thread.join();
}

}  // namespace raytracer
