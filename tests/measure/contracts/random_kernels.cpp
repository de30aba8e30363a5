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
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

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
  std::optional<std::uint64_t> scene_seed{};
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

std::span<const float> color(const Image& image, std::size_t pixel) {
  return std::span(image.values).subspan(3 * pixel, 3);
}

/// Whether a channel is off by more than a level, or is no number.
bool differs(const Image& image, const Image& expected, std::size_t pixel) {
  for (std::size_t c = 0; c < 3; ++c)
    if (!(std::abs(color(image, pixel)[c] - color(expected, pixel)[c]) <= 1.0F / 255)) return true;
  return false;
}

std::vector<std::size_t> differing_pixels(const Image& image, const Image& expected) {
  std::vector<std::size_t> pixels;
  for (std::size_t pixel = 0; pixel < image.values.size() / 3; ++pixel)
    if (differs(image, expected, pixel)) pixels.push_back(pixel);
  return pixels;
}

/// The reference with the eye moved by one rounding, along each axis to either side. What differs
/// there, too, no kernel can know: each thin mirror that a ray meets magnifies its error by as much
/// as the way to the next is longer than the mirror's radius.
std::vector<Image> from_next_to_the_eye(const Scene& scene, WorkerPool& pool) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<Image> images;
  for (double Vec3::*const axis : {&Vec3::x, &Vec3::y, &Vec3::z})
    for (const double side : {-infinity, infinity}) {
      Scene moved = scene;
      moved.camera.origin.*axis = std::nextafter(scene.camera.origin.*axis, side);
      const Plan plan = make_plan(moved, this_machine(), &pool);
      images.push_back(image_by(test::reference_plan(plan, Finder::tree), moved, pool));
    }
  return images;
}

struct Tally {
  std::uint64_t scenes = 0;
  std::uint64_t by_packets = 0;
  std::uint64_t pictures = 0;
  std::uint64_t pixels = 0;
  std::uint64_t wrong = 0;
  std::uint64_t unknowable = 0;
};

/// Counts these pixels, and prints a line for each.
void count_differing(const Image& image, const Image& expected,
                     const std::vector<std::size_t>& pixels, const std::vector<Image>& moved,
                     Tally& tally) {
  for (const std::size_t pixel : pixels) {
    const std::span<const float> here = color(image, pixel);
    const bool is_number =
        std::all_of(here.begin(), here.end(), [](float c) { return std::isfinite(c); });
    const bool is_unknowable =
        is_number && std::any_of(moved.begin(), moved.end(),
                                 [&](const Image& by) { return differs(by, expected, pixel); });
    ++(is_unknowable ? tally.unknowable : tally.wrong);
    const auto width = static_cast<std::size_t>(image.width);
    fmt::print("  pixel {}, {}: {:.4f}, by the reference {:.4f}{}\n", pixel % width, pixel / width,
               fmt::join(here, " "), fmt::join(color(expected, pixel), " "),
               is_unknowable ? "; another if the eye moves by a rounding" : "");
  }
}

void compare(std::uint64_t seed, WorkerPool& pool, Tally& tally) {
  const RandomScene drawn = random_scene(seed);
  const Scene scene = small_scene(drawn.document);
  const auto plan_on = [&](const Machine& machine) { return make_plan(scene, machine, &pool); };
  ++tally.scenes;
  const Plan plan = plan_on(this_machine());
  if (plan.kernel.value != Kernel::packets) return;
  ++tally.by_packets;
  const Image expected = image_by(test::reference_plan(plan, Finder::tree), scene, pool);
  std::vector<Image> moved;
  for (const InstructionSet& set : supported_instruction_sets()) {
    const Image image = image_by(plan_on({set}), scene, pool);
    const std::vector<std::size_t> pixels = differing_pixels(image, expected);
    ++tally.pictures;
    tally.pixels += expected.values.size() / 3;
    if (pixels.empty()) continue;
    if (moved.empty()) moved = from_next_to_the_eye(scene, pool);
    fmt::print("{} on {}: {} pixels differ: {}\n", seed, set.name, pixels.size(), drawn.summary);
    count_differing(image, expected, pixels, moved, tally);
  }
}

int run(const Options& options) {
  WorkerPool pool(options.threads);
  Tally tally;
  if (options.scene_seed)
    compare(*options.scene_seed, pool, tally);
  else
    for (std::uint64_t i = 0; i < options.scenes; ++i)
      compare(options.seed * 1'000'000 + i, pool, tally);
  fmt::print(
      "{} scenes, {} of them by packets, {} pictures, {} pixels: {} differ, and {} that differ in "
      "the reference as well if the eye moves by a rounding\n",
      tally.scenes, tally.by_packets, tally.pictures, tally.pixels, tally.wrong, tally.unknowable);
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
  app.add_option("--scene-seed", options.scene_seed, "Only the scene of this seed");
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
