// How long it takes a cluster to go on when a part of it is killed: a worker in the midst of a
// task, the front that had accepted a job, NATS for some seconds.
//
// Wall time: whatever else runs on this machine is in it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <exception>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "engine/measure/stopwatch.h"
#include "tests/cluster/nats_server.h"
#include "tests/measure/cluster/jobs.h"
#include "tests/measure/report/markdown_table.h"
#include "tests/measure/report/median.h"
#include "tests/process/patience.h"
#include "tests/process/server_process.h"

namespace {

using namespace raytracer;
using namespace raytracer::measure;
using Server = test::ServerProcess;

struct Options {
  int kills = 7;
  double task_timeout_s = 5;
  double away_s = 10;
};

const std::string long_job = "scene=square-500&width=1920&height=1080&samples=200";
/// One task, which ends with its time.
const std::string long_task = "scene=square-500&width=640&height=360&budget_ms=60000";
const std::string small_render = "/render?scene=first-sphere&width=96&height=72";

class Parts {
 public:
  explicit Parts(const Options& options)
      : flags_{"--nats",
               nats.url(),
               "--threads",
               "1",
               "--quiet",
               "--task-timeout",
               fmt::format("{}", options.task_timeout_s)} {}

  std::unique_ptr<Server> start(const std::vector<std::string>& more) const {
    std::vector<std::string> all = flags_;
    all.insert(all.end(), more.begin(), more.end());
    return std::make_unique<Server>(all);
  }

  test::NatsServer nats;

 private:
  std::vector<std::string> flags_;
};

void print(const std::string& what, const std::vector<double>& ms) {
  std::cout << row(what, ms.size(), digits(median(ms)),
                   digits(*std::max_element(ms.begin(), ms.end())));
}

/// From the death of who had a task to its next worker's beginning.
void kill_workers(const Options& options) {
  const Parts parts(options);
  const auto front = parts.start({"--no-work"});
  auto worker = parts.start({"--worker"});
  const auto redelivered = [&] {
    return nlohmann::json::parse(get(*front, "/cluster")).at("redelivered").get<int>();
  };
  std::vector<double> ms;
  for (int i = 0; i < options.kills; ++i) {
    await_workers(*front, 1);
    const std::string job = begin_job(*front, long_task);
    await_running_task(*front);
    auto other = parts.start({"--worker"});
    await_workers(*front, 2);
    const int before = redelivered();
    const Stopwatch stopwatch;
    worker->signal(SIGKILL);
    if (!test::eventually([&] { return redelivered() > before; }, std::chrono::seconds(60)))
      throw std::runtime_error("nobody took the task of a dead worker");
    ms.push_back(stopwatch.elapsed_ms());
    front->client().Delete(job);
    worker = std::move(other);
  }
  print(
      fmt::format("worker killed (--task-timeout {}): its task runs again", options.task_timeout_s),
      ms);
}

/// From the death of the front that accepted a job to another's answer.
void kill_fronts(const Options& options) {
  const Parts parts(options);
  const auto worker = parts.start({"--worker"});
  auto front = parts.start({"--no-work"});
  std::vector<double> ms;
  for (int i = 0; i < options.kills; ++i) {
    const auto other = parts.start({"--no-work"});
    await_workers(*other, 1);
    const std::string job = begin_job(*front, long_job);
    await_running_task(*front);
    const Stopwatch stopwatch;
    front->signal(SIGKILL);
    get(*other, job);
    ms.push_back(stopwatch.elapsed_ms());
    other->client().Delete(job);
    front = parts.start({"--no-work"});
  }
  print("front killed: another answers for its job", ms);
}

/// Small renders at both kinds of front meanwhile, and how long a job stands still afterwards.
void take_nats_away(const Options& options) {
  Parts parts(options);
  const auto front = parts.start({"--no-work"});
  const auto working = parts.start({});
  const auto worker = parts.start({"--worker"});
  await_workers(*front, 2);
  const std::string job = begin_job(*front, long_job);
  await_running_task(*front);
  std::vector<double> small_ms;
  const Stopwatch away;
  parts.nats.kill();
  while (away.elapsed_ms() < 1000 * options.away_s)
    for (const Server* const server : {front.get(), working.get()}) {
      const Stopwatch stopwatch;
      httplib::Client client = server->client();
      const auto answer = client.Get(small_render, {{"Cache-Control", "no-cache"}});
      if (!answer || answer->status != 200) throw std::runtime_error("a small render failed");
      small_ms.push_back(stopwatch.elapsed_ms());
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  const Stopwatch back;
  parts.nats.start();
  const auto progress = [&]() -> double {
    const auto answer = front->client().Get(job);
    if (!answer || answer->status != 200) return -1;
    return nlohmann::json::parse(answer->body).at("progress");
  };
  double first = -1;
  test::eventually([&] { return (first = progress()) >= 0; });
  if (!test::eventually([&] { return progress() > first; }, std::chrono::seconds(60)))
    throw std::runtime_error("the job does not go on");
  const double back_ms = back.elapsed_ms();
  await_end(*front, job);
  const Server alone;
  const std::string alone_job = begin_job(alone, long_job);
  await_end(alone, alone_job);
  if (get(*front, job + "/image") != get(alone, alone_job + "/image"))
    throw std::runtime_error("the job's picture is not that of a server alone");
  print(fmt::format("NATS away for {} s: a small render, none failed", options.away_s), small_ms);
  print("NATS back: a further task of a job is done, the picture is right", {back_ms});
}

}  // namespace

int main(int argc, char** argv) try {
  Options options;
  CLI::App app{"How long a cluster takes to go on when parts of it are killed."};
  app.add_option("--kills", options.kills, "Of each kind")->check(CLI::Range(1, 1000));
  app.add_option("--task-timeout", options.task_timeout_s, "Of all servers, in seconds")
      ->check(CLI::Range(0.5, 600.0));
  app.add_option("--away", options.away_s, "Seconds without NATS")->check(CLI::Range(0.5, 600.0));
  CLI11_PARSE(app, argc, argv);
  std::cout << row("what", "times", "median, ms", "longest, ms") << "|---|--:|--:|--:|\n";
  kill_workers(options);
  kill_fronts(options);
  take_nats_away(options);
} catch (const std::exception& error) {
  std::cerr << "raytracer_cluster_failures: " << error.what() << '\n';
  return 1;
}
