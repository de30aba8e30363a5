// Whether targets are kept on scenes that nobody has seen: random ones, of any seed.
//
//   raytracer_random_contracts [--seed N] [--scenes N]      status 1 if fewer than 99 % are kept
//   raytracer_random_contracts --scene-seed N [--write FILE]

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "engine/measure/stopwatch.h"
#include "tests/measure/contracts/random_report.h"
#include "tests/measure/contracts/random_scene.h"
#include "tests/measure/report/command_text.h"
#include "tests/measure/report/machine.h"
#include "tests/measure/report/written_file.h"

namespace {

using namespace raytracer;
using namespace raytracer::published;

constexpr std::uint64_t most_scenes = 1'000'000;

struct Options {
  std::uint64_t seed = 1;
  std::uint64_t scenes = 100;
  std::optional<std::uint64_t> scene_seed;
  std::string write;
  std::vector<double> targets{0.03, 0.01, 0.003};
  double exact_rays = 3e8;
  std::size_t threads = std::max(1U, std::thread::hardware_concurrency());
  std::string commit = "unknown";
};

/// Returns the exit status where there is nothing more to do.
std::optional<int> parse_arguments(int argc, char** argv, Options& options) {
  CLI::App app{"Renders random scenes to targets, and tells how far off the pictures truly are."};
  app.add_option("--seed", options.seed,
                 "Scene i has the seed N * 1,000,000 + i: another N, other scenes")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1'000'000'000'000}))
      ->capture_default_str();
  app.add_option("--scenes", options.scenes, "How many")
      ->check(CLI::Range(std::uint64_t{1}, most_scenes))
      ->capture_default_str();
  CLI::Option* const one =
      app.add_option("--scene-seed", options.scene_seed, "Only the scene of this seed");
  app.add_option("--write", options.write,
                 "Write that scene's document to FILE, and render nothing")
      ->needs(one);
  app.add_option("--target", options.targets, "A target; may be repeated")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--exact-rays", options.exact_rays,
                 "For an exact picture, about; 60 samples it has in any case")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--threads", options.threads, "Threads")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--commit", options.commit, "What is measured, for the report");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  return {};
}

std::vector<std::uint64_t> scene_seeds(const Options& options) {
  if (options.scene_seed) return {*options.scene_seed};
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t i = 0; i < options.scenes; ++i)
    seeds.push_back(options.seed * most_scenes + i);
  return seeds;
}

std::string progress_text(const MeasuredScene& scene, double seconds) {
  std::string text = fmt::format("{:6.1f} s  {}  {} (exact: {}, {:.1g})", seconds, scene.seed,
                                 scene.summary, scene.exact_samples, scene.exact_error);
  for (const MeasuredTarget& each : scene.targets)
    if (each.is_known)
      text += fmt::format("\n          {}: {:.3g}, estimate {:.3g}, {:.4g} samples{}", each.target,
                          each.rmse, each.estimated_error.value_or(0), each.samples_per_pixel,
                          each.rmse <= each.target ? "" : "  NOT KEPT");
  return text;
}

int measure_all(const Options& options, const std::string& command) {
  const measure::Machine machine = measure::describe_machine();
  std::cout << fmt::format(
                   "# Targets on random scenes\n\n`{}`, commit {}, {}, {} threads of {}, {}\n\n",
                   command, options.commit, measure::today(), options.threads, machine.processor,
                   machine.compiler)
            << std::flush;
  WorkerPool pool(options.threads);
  const Stopwatch watch;
  std::vector<MeasuredScene> scenes;
  std::size_t kept_count = 0;
  std::size_t count = 0;
  for (const std::uint64_t seed : scene_seeds(options)) {
    scenes.push_back(measure_random_scene(seed, options.targets, options.exact_rays, pool));
    std::cerr << progress_text(scenes.back(), watch.elapsed_ms() / 1000) << std::endl;
    for (const MeasuredTarget& each : scenes.back().targets) {
      if (!each.is_known) continue;
      ++count;
      if (each.rmse <= each.target) ++kept_count;
    }
  }
  std::cout << report_random(scenes)
            << fmt::format("It took {:.0f} s.\n", watch.elapsed_ms() / 1000);
  return is_enough(kept_count, count) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Options options;
    if (const auto status = parse_arguments(argc, argv, options)) return *status;
    if (options.write.empty())
      return measure_all(
          options, measure::command_text("raytracer_random_contracts", argc, argv, {"--commit"}));
    measure::write_file(options.write, random_scene(*options.scene_seed).document);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "raytracer_random_contracts: " << error.what() << '\n';
    return 2;
  }
}
