#include "engine/forecast/machine_costs.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "engine/image/image.h"
#include "engine/measure/stopwatch.h"
#include "engine/measure/thread_stopwatch.h"

namespace raytracer {
namespace {

/// The least of a few tries: what else the machine does can only make it more.
double least_start_ms(WorkerPool& pool) {
  constexpr int tries = 16;
  const std::atomic<bool> never{false};
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < tries; ++i) {
    const Stopwatch watch;
    pool.run(
        pool.thread_count(), [](std::size_t) {}, never);
    least = std::min(least, watch.elapsed_ms());
  }
  return least;
}

/// The least again, of memory that has been written before: a process that renders again and again
/// keeps it.
double least_pixel_ms() {
  constexpr int side_px = 1024;
  constexpr int tries = 4;
  Image image(side_px, side_px);
  std::fill(image.values.begin(), image.values.end(), 0.0F);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < tries; ++i) {
    const ThreadStopwatch watch;
    std::fill(image.values.begin(), image.values.end(), static_cast<float>(i));
    least = std::min(least, watch.elapsed_ms());
  }
  return least / (static_cast<double>(side_px) * side_px);
}

}  // namespace

MachineCosts measure_machine_costs(WorkerPool& pool) {
  return {least_start_ms(pool), least_pixel_ms()};
}

}  // namespace raytracer
