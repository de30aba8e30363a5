// The table of the extremes: each scene with this project's precisions and its peers, against the
// exact picture.
//
//   raytracer_extremes [--write FILE] [NAME...]

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <iostream>
#include <set>
#include <thread>

#include "engine/kernel/this_machine.h"
#include "engine/plan/plan.h"
#include "tests/extremes/cases.h"
#include "tests/extremes/comparison.h"
#include "tests/measure/peers/all_peers.h"
#include "tests/support/scene_plan.h"

namespace {

using namespace raytracer;
using namespace raytracer::extremes;

struct Row {
  std::string text;
  bool is_single;
  bool is_right;
  bool single_is_wrong;
};

std::string pixels_text(const Comparison& c) {
  return c.at_edge > 0 ? fmt::format("{} (+{})", c.off, c.at_edge) : fmt::format("{}", c.off);
}

/// Without what is found only at an edge: peers are compared as this project is. "-" for a scene
/// that is none of the peer's.
std::string wrong_pixels(peers::Peer& peer, const Scene& scene, const ExactImage& exact,
                         WorkerPool& pool) {
  if (peer.refusal(scene)) return "-";
  try {
    peer.set_scene(scene);
    const Image image = peers::stored(peer.draw().image, scene.render.transfer);
    if (!peer.omits_ambient(scene)) return pixels_text(compare(image, exact, scene));
    const Scene drawn = peers::scene_drawn(peer, scene);
    return pixels_text(compare(image, exact_image(drawn, pool), drawn));
  } catch (const std::runtime_error&) {
    return "fails";
  }
}

Row measure(const Extreme& extreme, const peers::Peers& all_peers, WorkerPool& pool) {
  const Scene& scene = extreme.scene;
  const ExactImage exact = exact_image(scene, pool);
  const Plan plan = make_plan(scene, this_machine(1));
  const auto against_exact = [&](Precision precision) {
    return compare(render_as(scene, precision, pool), exact, scene);
  };
  const Comparison chosen = against_exact(Precision::automatic);
  const Comparison single = against_exact(Precision::single_precision);
  const Comparison in_double = against_exact(Precision::double_precision);
  const bool is_single = plan.precision.value == Precision::single_precision;
  const ArithmeticError& predicted = plan.arithmetic_error;
  const bool is_right = chosen.off == 0 && chosen.nans == 0 &&
                        chosen.displacement_px <= std::max(1e-6, predicted.displacement_px) &&
                        chosen.levels <= predicted.levels;
  std::string text =
      fmt::format("| {} | {} | {:.1g} px, {:.1g} | {:.1g} px, {:.1g} | {} | {} | {} |",
                  extreme.name, name_of(plan.precision.value), predicted.displacement_px,
                  predicted.levels, chosen.displacement_px, chosen.levels, pixels_text(chosen),
                  pixels_text(single), pixels_text(in_double));
  for (const auto& peer : all_peers)
    text += fmt::format(" {} |", wrong_pixels(*peer, scene, exact, pool));
  return {text + '\n', is_single, is_right, single.off > 0};
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"Renders the extremes and compares them with the exact pictures."};
  std::string path;
  std::vector<std::string> names;
  std::size_t threads = std::max(1U, std::thread::hardware_concurrency());
  app.add_option("--write", path, "Also write the table to this file");
  app.add_option("--threads", threads, "Threads")->check(CLI::PositiveNumber);
  app.add_option("names", names, "Only these scenes");
  CLI11_PARSE(app, argc, argv);

  WorkerPool pool(threads);
  const auto all_peers = peers::all_peers(pool);
  std::string report =
      "# The extremes, printed by `make extremes`\n\n"
      "Pixels off by more than a level of 255, in brackets those that are right within 1e-6 "
      "pixel.\n\n"
      "| scene | auto | predicted | measured | auto: pixels wrong | single | double |";
  std::string rule = "\n|---|---|---|---|--:|--:|--:|";
  for (const auto& peer : all_peers) {
    report += fmt::format(" {} |", peer->name());
    rule += "--:|";
  }
  report += rule + '\n';
  std::cout << report << std::flush;
  int count = 0;
  int right = 0;
  int in_single = 0;
  int needs_double = 0;
  for (const Extreme& extreme : all_extremes()) {
    if (!names.empty() && std::count(names.begin(), names.end(), extreme.name) == 0) continue;
    const Row row = measure(extreme, all_peers, pool);
    std::cout << row.text << std::flush;
    report += row.text;
    ++count;
    right += row.is_right ? 1 : 0;
    in_single += row.is_single ? 1 : 0;
    needs_double += !row.is_single && row.single_is_wrong ? 1 : 0;
  }
  const std::string summary = fmt::format(
      "\n{} scenes: {} right on auto, within what was predicted; {} of them in single; {} in "
      "double that single gets wrong.\n",
      count, right, in_single, needs_double);
  std::cout << summary;
  if (!path.empty() && !(std::ofstream(path) << report << summary).flush())
    throw std::runtime_error("cannot write " + path);
  return right == count ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << "extremes: " << error.what() << '\n';
  return 2;
}
