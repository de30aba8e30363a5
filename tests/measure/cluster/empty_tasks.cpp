#include "tests/measure/cluster/empty_tasks.h"

#include <chrono>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "engine/measure/stopwatch.h"
#include "server/cluster/store.h"
#include "tests/measure/cluster/nats.h"
#include "tests/process/patience.h"
#include "tests/process/server_process.h"

namespace raytracer::measure {
namespace {

constexpr int side_px = 16, columns = 60, rows = 34;

/// A sphere that nobody sees.
const std::string scene = R"({"camera": {"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 0.5,
  "width": 960, "height": 544}, "objects": [{"type": "sphere", "center": [0, 900, 0],
  "radius": 1}], "render": {"samples": 1}})";

/// One thread's server of a cluster.
test::ServerProcess member(const Nats& nats, const char* kind) {
  return test::ServerProcess({"--nats", nats.url(), "--threads", "1", "--quiet", kind});
}

JobRecord new_job(const std::string& id, const std::string& renderer) {
  return {.id = id,
          .document = ClusterStore::digest_of(scene),
          .renderer = renderer,
          .front = "measurement",
          .is_8_bit = true,
          .width = side_px * columns,
          .height = side_px * rows,
          .accepted_ms = now_ms(),
          .side_px = side_px,
          .task_count = columns * rows};
}

/// Of each process so far.
TaskCosts taken(const Nats& nats, const test::ServerProcess& worker,
                const test::ServerProcess& front) {
  return {nats.processor_ms(), processor_ms(worker.id()), processor_ms(front.id())};
}

}  // namespace

TaskCosts measure_empty_tasks() {
  const Nats nats;
  NatsConnection connection(nats.url());
  if (!test::eventually([&] { return connection.is_connected(); }))
    throw std::runtime_error("no connection to NATS");
  ClusterStore store(connection, StoreLimits{});
  store.ensure_streams();
  const test::ServerProcess front = member(nats, "--no-work");
  const test::ServerProcess worker = member(nats, "--worker");
  std::string renderer;
  test::eventually([&] {
    for (const Member& heard : store.members())
      if (heard.works) renderer = heard.renderer;
    return !renderer.empty();
  });
  store.put_document(ClusterStore::digest_of(scene), scene);
  const auto run = [&](const std::string& id) {
    JobRecord record = new_job(id, renderer);
    store.put_job(record);
    std::vector<int> tasks(static_cast<std::size_t>(record.task_count));
    std::iota(tasks.begin(), tasks.end(), 0);
    store.queue_tasks(record, tasks);
    // Somebody watches, so that the front collects the results as they come.
    httplib::Client client = front.client();
    client.set_read_timeout(120);
    const httplib::Result events = client.Get("/jobs/" + id + "/events");
    if (!events || events->body.find("event: done") == std::string::npos)
      throw std::runtime_error("the job of empty tasks does not end: " +
                               (events ? events->body : "no answer"));
  };
  run("first");  // the scene travels, and is made ready
  const TaskCosts before = taken(nats, worker, front);
  const Stopwatch stopwatch;
  run("measured");
  const double job_ms = stopwatch.elapsed_ms();
  const TaskCosts after = taken(nats, worker, front);
  std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(job_ms));
  const TaskCosts idle = taken(nats, worker, front);
  const auto of_task = [&](double TaskCosts::*part) {
    return (2 * (after.*part) - before.*part - idle.*part) / (columns * rows);
  };
  return {of_task(&TaskCosts::nats_ms), of_task(&TaskCosts::worker_ms),
          of_task(&TaskCosts::front_ms)};
}

}  // namespace raytracer::measure
