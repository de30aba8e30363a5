// The project beside its peers on the same scenes, in turn in one run.
//
// Prints a Markdown report; with --runs it also writes it, and the raw figures, to
// DIRECTORY/DATE-COMMIT.md and .json.

#include <fmt/format.h>
#include <hwy/targets.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <thread>

#include "tests/measure/bench/measure_case.h"
#include "tests/measure/bench/report.h"
#include "tests/measure/report/command_text.h"
#include "tests/measure/report/print_measured.h"
#include "tests/measure/report/written_file.h"

namespace {

using namespace raytracer;
using namespace raytracer::bench;

struct Options {
  std::vector<std::string> scenes;
  bool is_quick = false;
  std::vector<std::string> peers;
  bool is_avx2 = false;
  Effort effort;
  std::size_t threads = std::max(1U, std::thread::hardware_concurrency());
  std::string commit = "unknown";
  std::string runs;
  std::string pictures;
  std::string shipped = "server/scenes";
};

/// Returns the exit status where there is nothing more to do.
std::optional<int> parse_arguments(int argc, char** argv, Options& options) {
  CLI::App app{"Measures the project and its peers on the same scenes, in turn."};
  app.add_option("--scene", options.scenes,
                 "Only this scene: one that is made here, a shipped one, or a document's path; may "
                 "be repeated");
  app.add_flag("--quick", options.is_quick, "Only small scenes at 700 x 500 with one sample");
  app.add_option("--peer", options.peers, "Only this peer; may be repeated")
      ->check(CLI::IsMember({"Embree", "POV-Ray", "Tachyon"}));
  app.add_flag("--avx2", options.is_avx2, "Let the project use no more than AVX2; Embree may");
  app.add_option("--rounds", options.effort.rounds, "Rounds of each case")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--seconds", options.effort.seconds_per_case,
                 "After so long a case has no further round, if it had three")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--threads", options.threads, "Threads of every peer")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--commit", options.commit, "What is measured, for the report");
  app.add_option("--runs", options.runs, "Write the report into this directory")
      ->check(CLI::ExistingDirectory);
  app.add_option("--pictures", options.pictures, "Write every peer's pictures into this directory")
      ->check(CLI::ExistingDirectory);
  app.add_option("--shipped", options.shipped, "Where the shipped scenes are")
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  return {};
}

/// The standard cases of the scenes that are named; a scene without any as its document has it.
std::vector<Case> wanted_cases(const Options& options) {
  const std::vector<Case> standard = standard_cases(options.shipped);
  std::vector<Case> cases;
  if (options.scenes.empty()) cases = standard;
  for (const std::string& name : options.scenes) {
    const std::size_t before = cases.size();
    for (const Case& each : standard)
      if (each.scene.name == name) cases.push_back(each);
    if (cases.size() == before) cases.push_back({measure::find_scene(name, options.shipped)});
  }
  if (options.is_quick) std::erase_if(cases, [](const Case& each) { return !each.is_quick; });
  return cases;
}

peers::Peers wanted_peers(const Options& options, WorkerPool& pool) {
  peers::Peers all = peers::all_peers(pool);
  if (!options.peers.empty())
    std::erase_if(all, [&](const auto& peer) {
      return std::count(options.peers.begin(), options.peers.end(), peer->name()) == 0;
    });
  return all;
}

void write_pictures(const CaseFigures& figures, const std::filesystem::path& directory,
                    WorkerPool& pool) {
  const auto write = [&](const ByteImage& image, const std::string& what) {
    if (image.values.empty()) return;
    std::string name = figures.measured.name() + ", " + what + ".png";
    std::replace(name.begin(), name.end(), ' ', '-');
    std::erase(name, ',');
    measure::write_file(directory / name, encode(image, ImageFormat::png, pool));
  };
  for (const PeerFigures& peer : figures.peers) {
    write(peer.picture, peer.name);
    write(peer.project_picture, "project as " + peer.name);
  }
}

/// As DATE-COMMIT.md and .json.
void write_report(const Report& report, const std::filesystem::path& directory) {
  const std::string name = report.head.date + '-' + report.head.commit;
  measure::write_file(directory / (name + ".md"), to_markdown(report));
  measure::write_file(directory / (name + ".json"), to_json(report));
}

/// Measures every case that is wanted. Writes the report after each: a run takes long.
Report measure_all(const Options& options, const std::string& command) {
  // Before the engine asks what there is.
  if (options.is_avx2) hwy::SetSupportedTargetsForTest(HWY_AVX2 | HWY_SSE4 | HWY_SSSE3);
  const std::vector<Case> cases = wanted_cases(options);
  WorkerPool pool(options.threads);
  const MachineCosts costs = measure_machine_costs(pool);
  const auto all_peers = wanted_peers(options, pool);
  Report report{.head = {.date = measure::today(),
                         .commit = options.commit,
                         .command = command,
                         .thread_count = options.threads,
                         .machine = measure::describe_machine()}};
  for (const auto& peer : all_peers) report.head.peers.emplace_back(peer->name(), peer->version());
  for (const Case& each : cases) {
    std::cerr << each.name() << std::endl;
    CaseFigures figures = measure_case(each, options.effort, costs, all_peers, pool);
    if (!options.pictures.empty()) write_pictures(figures, options.pictures, pool);
    for (PeerFigures& peer : figures.peers) peer.picture = peer.project_picture = {};
    report.cases.push_back(std::move(figures));
    if (!options.runs.empty()) write_report(report, options.runs);
  }
  return report;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return measure::print_measured(
      "bench", [&] { return parse_arguments(argc, argv, options); },
      [&] {
        return to_markdown(
            measure_all(options, measure::command_text("raytracer_bench", argc, argv,
                                                       {"--runs", "--pictures", "--commit"})));
      });
}
