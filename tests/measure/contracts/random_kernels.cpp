// Whether every kernel on every instruction set of this machine draws what the reference draws, on
// random scenes.
//
//   raytracer_random_kernels [--seed N] [--scenes N]      status 1 if a pixel differs

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <iostream>
#include <string>
#include <thread>

#include "engine/engine.h"
#include "engine/kernel/this_machine.h"
#include "engine/render/tracer.h"
#include "engine/sample/pattern.h"
#include "tests/measure/contracts/random_scene.h"
#include "tests/support/reference_plan.h"
#include "tests/support/scene_plan.h"

namespace {

using namespace raytracer;
using namespace raytracer::published;

constexpr int width_px = 96;

struct Options {
  std::uint64_t seed = 1;
  std::uint64_t scenes = 100;
  std::size_t threads = std::max(1U, std::thread::hardware_concurrency());
};

/// One sample a pixel, in linear light, in double.
Scene small_scene(const std::string& document) {
  Overrides overrides;
  overrides.samples = 1;
  overrides.transfer = Transfer::linear;
  overrides.precision = Precision::double_precision;
  Scene scene = read_scene(document, Limits{}, overrides).value();
  scene.camera.height = std::max(1, scene.camera.height * width_px / scene.camera.width);
  scene.camera.width = width_px;
  return scene;
}

Image image_by(const Plan& plan, const Scene& scene, WorkerPool& pool) {
  const Tracer tracer = make_tracer(plan, pack_scene(scene, &pool), pool);
  Image image(scene.camera.width, scene.camera.height);
  for (const Tile& tile : split_into_tiles(image.width, image.height, 32))
    render_tile(tracer, sample_pattern(1), tile, {scene.render.transfer, &image});
  return image;
}

/// Pixels with a channel that is off by more than a level, or is no number.
int count_wrong(const Image& image, const Image& expected) {
  int wrong = 0;
  for (std::size_t i = 0; i < image.values.size(); i += 3) {
    const auto is_off = [&](std::size_t c) {
      return !(std::abs(image.values[i + c] - expected.values[i + c]) <= 1.0F / 255);
    };
    wrong += is_off(0) || is_off(1) || is_off(2) ? 1 : 0;
  }
  return wrong;
}

struct Tally {
  std::uint64_t scenes = 0;
  std::uint64_t by_packets = 0;
  std::uint64_t pictures = 0;
  std::uint64_t pixels = 0;
  std::uint64_t wrong = 0;
};

void compare(std::uint64_t seed, WorkerPool& pool, Tally& tally) {
  const RandomScene drawn = random_scene(seed);
  const Scene scene = small_scene(drawn.document);
  const auto plan_on = [&](const Machine& machine) { return make_plan(scene, machine, &pool); };
  ++tally.scenes;
  const Plan plan = plan_on(this_machine());
  if (plan.kernel.value != Kernel::packets) return;
  ++tally.by_packets;
  const Image expected = image_by(test::reference_plan(plan, Finder::tree), scene, pool);
  for (const InstructionSet& set : supported_instruction_sets()) {
    const int wrong = count_wrong(image_by(plan_on({set}), scene, pool), expected);
    ++tally.pictures;
    tally.pixels += expected.values.size() / 3;
    tally.wrong += static_cast<std::uint64_t>(wrong);
    if (wrong > 0)
      fmt::print("{} on {}: {} pixels differ: {}\n", seed, set.name, wrong, drawn.summary);
  }
}

int run(const Options& options) {
  WorkerPool pool(options.threads);
  Tally tally;
  for (std::uint64_t i = 0; i < options.scenes; ++i)
    compare(options.seed * 1'000'000 + i, pool, tally);
  fmt::print("{} scenes, {} of them by packets, {} pictures, {} pixels: {} differ\n", tally.scenes,
             tally.by_packets, tally.pictures, tally.pixels, tally.wrong);
  return tally.wrong == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"Draws random scenes by every kernel, and compares them with the reference."};
  app.add_option("--seed", options.seed,
                 "Scene i has the seed N * 1,000,000 + i: another N, other scenes")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1'000'000'000'000}))
      ->capture_default_str();
  app.add_option("--scenes", options.scenes, "How many")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000}))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "Threads")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  try {
    return run(options);
  } catch (const std::exception& error) {
    std::cerr << "raytracer_random_kernels: " << error.what() << '\n';
    return 1;
  }
}
