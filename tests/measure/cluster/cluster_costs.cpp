// What a shared job costs, measured here: how long the tasks of a real job trace, how much of its
// time a NATS server of the program's own takes for each task, and what a task costs a worker and a
// front beside its tracing. For raytracer_cluster_simulation.
//
// The clock of the tasks is this machine's; of all else the processor's time counts, so that others
// who run here disturb it little.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/measure/stopwatch.h"
#include "server/cluster/cut.h"
#include "server/cluster/store.h"
#include "tests/measure/cluster/empty_tasks.h"
#include "tests/measure/cluster/nats.h"
#include "tests/measure/scenes/named_scene.h"
#include "tests/process/patience.h"

namespace {

using namespace raytracer;
using measure::Nats;

struct Options {
  std::string scene = "square-500";
  std::string shipped = "server/scenes";
  int width = 1920, height = 1080, samples = 64;
  int tasks = 300;
  bool are_floats = false;
};

struct RealJob {
  std::vector<double> task_ms{};
  std::size_t result_bytes = 0;  ///< the mean's
};

/// One thread traces all regions, after the other.
template <typename Channel>
RealJob trace(const Options& options) {
  const auto named = measure::find_scene(options.scene, options.shipped);
  Scene scene = measure::read_document(named.document(), {});
  scene.camera.width = options.width;
  scene.camera.height = options.height;
  scene.render.samples = options.samples;
  scene.render.target_rmse.reset();
  scene.render.budget_ms.reset();
  WorkerPool pool(1);
  const PreparedScene prepared(scene, pool);
  RenderProgress progress;
  const auto prediction = predict(prepared, Limits{}, measure_machine_costs(pool), pool, progress);
  const TaskCut cut = cut_into_tasks(prepared, prediction.value(), sizeof(Channel) == 1);
  RealJob job;
  for (const Tile& region : regions_of(options.width, options.height, cut.side_px)) {
    const Stopwatch stopwatch;
    const auto part = render_region<Channel>(prepared, region, pool, progress);
    job.task_ms.push_back(stopwatch.elapsed_ms());
    job.result_bytes +=
        part->values.size() * sizeof(Channel) + part->subtile_error2.size() * sizeof(double);
  }
  job.result_bytes /= job.task_ms.size();
  return job;
}

/// Milliseconds of NATS's processor for each task: queued, taken, looked up, its result stored and
/// told to a front, acknowledged, and fetched.
double nats_ms(const Options& options, std::size_t result_bytes) {
  const Nats nats;
  NatsConnection connection(nats.url());
  test::eventually([&] { return connection.is_connected(); });
  ClusterStore store(connection, StoreLimits{});
  store.ensure_streams();
  const auto listener = store.listen_for_news([] {}, true);

  const std::string result(result_bytes, 'x');
  const double before_ms = nats.processor_ms();
  JobRecord record;
  record.id = "measured";
  record.renderer = "here";
  record.document = "scene";
  record.task_count = options.tasks;
  store.put_job(record);
  std::vector<int> tasks(static_cast<std::size_t>(options.tasks));
  for (int i = 0; i < options.tasks; ++i) tasks[static_cast<std::size_t>(i)] = i;
  store.queue_tasks(record, tasks);
  TaskSource source = store.tasks_of({record.id, record.renderer, record.document});
  for (int i = 0; i < options.tasks; ++i) {
    auto task = source.take(std::chrono::seconds(5));
    const int number = ClusterStore::task_of(task.value().subject()).second;
    store.job(record.id);
    store.put_result(record.id, number, result);
    task->acknowledge();
    store.result(record.id, number);
  }
  return (nats.processor_ms() - before_ms) / options.tasks;
}

void measure_all(const Options& options) {
  const RealJob job = options.are_floats ? trace<float>(options) : trace<unsigned char>(options);
  const measure::TaskCosts empty = measure::measure_empty_tasks();
  const nlohmann::ordered_json figures{
      {"scene", fmt::format("{} {} x {} x {}", options.scene, options.width, options.height,
                            options.samples)},
      {"result_bytes", job.result_bytes},
      {"nats_ms", nats_ms(options, job.result_bytes)},
      {"empty_task",
       {{"nats_ms", empty.nats_ms}, {"worker_ms", empty.worker_ms}, {"front_ms", empty.front_ms}}},
      {"task_ms", job.task_ms}};
  std::cout << figures.dump() << '\n';
}

}  // namespace

int main(int argc, char** argv) try {
  Options options;
  CLI::App app{"Measures what a shared job costs: JSON for raytracer_cluster_simulation."};
  app.add_option("--scene", options.scene, "Name of a shipped scene, or a file");
  app.add_option("--shipped", options.shipped, "Folder of the shipped scenes");
  app.add_option("--width", options.width, "Pixels");
  app.add_option("--height", options.height, "Pixels");
  app.add_option("--samples", options.samples, "Samples per pixel");
  app.add_flag("--floats", options.are_floats, "Results as jobs whose floats are announced have");
  app.add_option("--tasks", options.tasks, "Tasks that go through NATS")
      ->check(CLI::Range(1, 100'000));
  CLI11_PARSE(app, argc, argv);
  measure_all(options);
} catch (const std::exception& error) {
  std::cerr << "raytracer_cluster_costs: " << error.what() << '\n';
  return 1;
}
