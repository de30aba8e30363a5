// Looks something up for those who cannot wait long for it.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

namespace raytracer {

class Refresher {
 public:
  /// `refresh` is called on another thread; it throws nothing.
  explicit Refresher(std::function<void()> refresh)
      : refresh_(std::move(refresh)),
        thread_([this](const std::stop_token& end) { refresh_until(end); }) {}

  /// Returns once it was called again, or after `longest`: where a call takes longer than that,
  /// at once.
  void refresh(std::chrono::milliseconds longest) {
    std::unique_lock lock(mutex_);
    if (begun_ != done_ && Clock::now() - began_ > longest) return;
    const std::uint64_t mine = ++asked_;
    changed_.notify_all();
    changed_.wait_for(lock, longest, [&] { return done_ >= mine; });
  }

 private:
  using Clock = std::chrono::steady_clock;

  void refresh_until(const std::stop_token& end) {
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, end, [this] { return asked_ != done_; })) {
      if (end.stop_requested()) return;
      begun_ = asked_;
      began_ = Clock::now();
      lock.unlock();
      refresh_();
      lock.lock();
      done_ = begun_;
      changed_.notify_all();
    }
  }

  const std::function<void()> refresh_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::uint64_t asked_ = 0;  ///< how often
  std::uint64_t begun_ = 0;  ///< how much of that the last call is for
  std::uint64_t done_ = 0;
  Clock::time_point began_;
  std::jthread thread_;
};

}  // namespace raytracer
