// Milliseconds of processor time that this thread has used since it was made: they stand still
// while something else has the core.
#pragma once

#include <ctime>

namespace raytracer {

/// For the thread that made it.
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
