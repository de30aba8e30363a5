// What a task costs that has nothing to trace.
#pragma once

namespace raytracer::measure {

/// Milliseconds of the processor for each task.
struct TaskCosts {
  double nats_ms = 0;
  double worker_ms = 0;
  double front_ms = 0;
};

/// By a job of some thousand regions of background, at a front and a worker that run for this
/// alone. What they take while nothing is to be done is not in it.
TaskCosts measure_empty_tasks();

}  // namespace raytracer::measure
