// How long small renders take at a front while a large job is shared, beside an idle front: at one
// that leaves the work to a worker, and at one that works too.
//
// Wall time: whatever else runs on this machine is in it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/measure/stopwatch.h"
#include "tests/measure/cluster/jobs.h"
#include "tests/measure/cluster/nats.h"
#include "tests/measure/report/markdown_table.h"
#include "tests/process/server_process.h"

namespace {

using namespace raytracer;
using namespace raytracer::measure;

struct Options {
  int renders = 300;
  std::string job = "scene=square-500&width=1920&height=1080&samples=300";
};

/// The 95th of 100, in milliseconds, of renders that no cache answers.
double small_render_p95(const test::ServerProcess& front, int renders) {
  httplib::Client client = front.client();
  client.set_keep_alive(true);
  std::vector<double> times;
  for (int i = 0; i < renders; ++i) {
    const Stopwatch stopwatch;
    const auto answer = client.Get("/render?scene=first-sphere&width=96&height=72",
                                   {{"Cache-Control", "no-cache"}});
    times.push_back(stopwatch.elapsed_ms());
    if (!answer || answer->status != 200) throw std::runtime_error("a small render failed");
  }
  const auto at = times.begin() + static_cast<std::ptrdiff_t>(times.size() * 95 / 100);
  std::nth_element(times.begin(), at, times.end());
  return *at;
}

void compare(const Options& options, bool front_works) {
  const Nats nats;
  std::vector<std::string> flags{"--nats", nats.url(), "--threads", "1", "--quiet"};
  const auto with = [&](const char* flag) {
    std::vector<std::string> all = flags;
    all.emplace_back(flag);
    return all;
  };
  const test::ServerProcess front(front_works ? flags : with("--no-work"));
  const test::ServerProcess worker(with("--worker"));
  await_workers(front, front_works ? 2 : 1);
  const double idle_ms = small_render_p95(front, options.renders);
  const std::string job = begin_job(front, options.job);
  await_running_task(front);
  const double beside_ms = small_render_p95(front, options.renders);
  if (get(front, job).find("\"running\"") == std::string::npos)
    throw std::runtime_error("the job was too short");
  front.client().Delete(job);
  std::cout << row(front_works ? "works" : "--no-work", fmt::format("{:.2f}", idle_ms),
                   fmt::format("{:.2f}", beside_ms), fmt::format("{:.2f}", 2 * idle_ms + 5));
}

}  // namespace

int main(int argc, char** argv) try {
  Options options;
  CLI::App app{"Small renders at a front, beside a large shared job."};
  app.add_option("--renders", options.renders, "Of each kind")->check(CLI::Range(20, 100'000));
  app.add_option("--job", options.job, "Query of the large job");
  CLI11_PARSE(app, argc, argv);
  std::cout << row("front", "idle: p95, ms", "beside the job: p95, ms", "twice idle + 5 ms")
            << "|---|--:|--:|--:|\n";
  for (const bool front_works : {false, true}) compare(options, front_works);
} catch (const std::exception& error) {
  std::cerr << "raytracer_cluster_latency: " << error.what() << '\n';
  return 1;
}
