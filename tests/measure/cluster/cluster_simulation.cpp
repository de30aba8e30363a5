// How far a cluster scales, by simulation.cpp with the costs that raytracer_cluster_costs measured.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/measure/cluster/efficiency_svg.h"
#include "tests/measure/cluster/simulation.h"
#include "tests/measure/report/markdown_table.h"
#include "tests/measure/report/written_file.h"

namespace {

using namespace raytracer::measure;

struct Options {
  std::vector<std::string> files;
  std::string svg;
  std::size_t tasks = 100'000;
  std::uint64_t seed = 1;
  ClusterCosts costs;
  Losses losses;
};

void parse_arguments(CLI::App& app, Options& options) {
  app.add_option("COSTS", options.files, "What raytracer_cluster_costs printed")->required();
  app.add_option("--svg", options.svg, "Where to draw it");
  app.add_option("--tasks", options.tasks, "Of the job")->check(CLI::Range(1, 10'000'000));
  app.add_option("--seed", options.seed, "Of what is drawn");
  app.add_option("--scene-bytes", options.costs.scene_bytes, "To each worker")
      ->capture_default_str();
  app.add_option("--link", options.costs.link_bytes_per_ms, "Bytes per millisecond, of NATS")
      ->capture_default_str();
  app.add_option("--loss-every-ms", options.losses.every_ms, "A worker is lost")
      ->capture_default_str();
  app.add_option("--timeout-ms", options.losses.timeout_ms, "Until its task is taken by others")
      ->capture_default_str();
}

/// The name of what was measured; the rest goes into `costs`.
std::string read_costs(const std::string& path, ClusterCosts& costs) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  const auto json = nlohmann::json::parse(file);
  costs.task_ms = json.at("task_ms").get<std::vector<double>>();
  if (costs.task_ms.empty()) throw std::runtime_error(path + ": there are no tasks in it");
  costs.result_bytes = json.at("result_bytes");
  costs.nats_ms = json.at("nats_ms");
  costs.worker_ms = json.at("empty_task").at("worker_ms");
  costs.front_ms = json.at("empty_task").at("front_ms");
  return json.at("scene");
}

/// What ends first, if more workers come.
std::string busiest(const SimulatedJob& job) {
  const double most = std::max({job.nats_load, job.link_load, job.front_load});
  return most == job.nats_load ? "NATS" : most == job.link_load ? "network" : "front";
}

void simulate_all(Options options) {
  std::vector<EfficiencyCurve> curves;
  std::cout << row("job", "workers", "minutes", "efficiency", "tasks lost", "NATS busy",
                   "network busy", "front busy")
            << "|---|--:|--:|--:|--:|--:|--:|--:|\n";
  std::string bends;
  for (const std::string& path : options.files) {
    const std::string scene = read_costs(path, options.costs);
    EfficiencyCurve curve{
        fmt::format("{}: {:.0f} kB a task", scene, options.costs.result_bytes / 1000), {}};
    const SimulatedJob* bend = nullptr;
    curve.jobs.reserve(40);
    for (double exponent = 1; exponent < 4.01; exponent += 0.125) {
      const auto workers = static_cast<std::size_t>(std::lround(std::pow(10, exponent)));
      curve.jobs.push_back(
          simulate(options.costs, options.losses, workers, options.tasks, options.seed));
      const SimulatedJob& job = curve.jobs.back();
      if (!bend && job.efficiency < 0.9) bend = &job;
      if (workers != 10 && workers != 100 && workers != 1000) continue;
      std::cout << row(scene, workers, fmt::format("{:.1f}", job.job_ms / 60'000),
                       percent(job.efficiency), job.lost_tasks, percent(job.nats_load),
                       percent(job.link_load), percent(job.front_load));
    }
    if (bend)
      bends += fmt::format("{}: below 90 % from {} workers on; busiest is then: {}\n", scene,
                           bend->workers, busiest(*bend));
    curves.push_back(std::move(curve));
  }
  std::cout << '\n' << bends;
  if (!options.svg.empty()) write_file(options.svg, efficiency_svg(curves));
}

}  // namespace

int main(int argc, char** argv) try {
  Options options;
  CLI::App app{"Simulates one job on clusters of 10 to 10,000 workers."};
  parse_arguments(app, options);
  CLI11_PARSE(app, argc, argv);
  simulate_all(options);
} catch (const std::exception& error) {
  std::cerr << "raytracer_cluster_simulation: " << error.what() << '\n';
  return 1;
}
