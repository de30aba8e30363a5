// A cluster on paper: workers, one NATS server, its link in and out, and one front work off a
// job. Each but the workers does one thing after the other, in the order of arrival, and takes
// a fixed time for a task or a byte; workers take as long as tasks of a real job took.
//
// Left out: the front's own tracing, other jobs, the network's latency, NATS's memory and disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace raytracer::measure {

struct ClusterCosts {
  std::vector<double> task_ms;  ///< of a real job; tasks are drawn from these
  double worker_ms = 3;         ///< of a worker's time, for each task beside its tracing
  double front_ms = 1;          ///< of a front's time, for each result
  double nats_ms = 0.3;         ///< of one core of NATS, for each task
  double result_bytes = 0;
  double scene_bytes = 20e6;         ///< to each worker once
  double scene_ready_ms = 100;       ///< to read it and build its structures
  double link_bytes_per_ms = 117e3;  ///< of NATS: 1 Gbit/s
};

struct Losses {
  double every_ms = 10'000;     ///< a worker is lost, any of them
  double timeout_ms = 5'000;    ///< then others take its task
  double replaced_ms = 10'000;  ///< then another worker comes, which has no scene
};

struct SimulatedJob {
  std::size_t workers = 0;
  double job_ms = 0;
  double efficiency = 0;  ///< tracing that counted, of the time that workers were there
  std::size_t lost_tasks = 0;
  double nats_load = 0, link_load = 0, front_load = 0;  ///< of the job's time
};

SimulatedJob simulate(const ClusterCosts& costs, const Losses& losses, std::size_t workers,
                      std::size_t tasks, std::uint64_t seed);

}  // namespace raytracer::measure
