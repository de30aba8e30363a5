// Milliseconds since a stopwatch was made.
#pragma once

#include <chrono>
#include <ctime>

namespace raytracer {

/// By the clock that never jumps.
class Stopwatch {
 public:
  double elapsed_ms() const {
    return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// Of processor time that the thread which made it has used: they stand still while something else
/// has the core.
class ThreadStopwatch {
 public:
  double elapsed_ms() const { return now_ms() - start_ms_; }

 private:
  static double now_ms() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
  }

  double start_ms_ = now_ms();
};

}  // namespace raytracer
