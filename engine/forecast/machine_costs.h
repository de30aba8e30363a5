// What a render costs on this machine beyond tracing: measured once.
#pragma once

#include "engine/parallel/worker_pool.h"

namespace raytracer {

struct MachineCosts {
  double start_ms = 0;  ///< of each pass over an image: until threads that slept have all begun
  double byte_ms = 0;   ///< of one thread, to write a byte of an image into memory that it has
};

/// Takes a few milliseconds, on the pool's threads and this one.
MachineCosts measure_machine_costs(WorkerPool& pool);

}  // namespace raytracer
