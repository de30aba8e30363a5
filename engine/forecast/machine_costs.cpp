#include "engine/forecast/machine_costs.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <thread>

#include "engine/errors/error_model.h"
#include "engine/image/image.h"
#include "engine/math/vec.h"
#include "engine/measure/stopwatch.h"

namespace raytracer {
namespace {

using Model = ForecastModel;

/// The median: how long a thread sleeps on varies.
double usual_start_ms(WorkerPool& pool) {
  std::array<double, Model::tries> starts{};
  for (double& start_ms : starts) {
    std::this_thread::sleep_for(std::chrono::microseconds{Model::threads_sleep_us});
    std::atomic<std::size_t> begun{0};
    const Stopwatch watch;
    pool.run(pool.thread_count(), [&](std::size_t) {
      ++begun;
      while (begun < pool.thread_count() && watch.elapsed_ms() < Model::longest_start_ms)
        std::this_thread::yield();
    });
    start_ms = watch.elapsed_ms();
  }
  std::ranges::nth_element(starts, starts.begin() + Model::tries / 2);
  return starts[Model::tries / 2];
}

/// The least of a few tries: what else the machine does can only make it more. Of memory that has
/// been written before: a process that renders again and again keeps it.
double least_byte_ms() {
  Image image(Model::memory_side_px, Model::memory_side_px);
  std::fill(image.values.begin(), image.values.end(), 0.0F);
  double least = infinity;
  for (int i = 0; i < Model::tries; ++i) {
    const ThreadStopwatch watch;
    std::fill(image.values.begin(), image.values.end(), static_cast<float>(i));
    least = std::min(least, watch.elapsed_ms());
  }
  return least / static_cast<double>(image.values.size() * sizeof(image.values[0]));
}

}  // namespace

MachineCosts measure_machine_costs(WorkerPool& pool) {
  return {usual_start_ms(pool), least_byte_ms()};
}

}  // namespace raytracer
