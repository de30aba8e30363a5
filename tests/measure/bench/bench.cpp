// The project against Embree and POV-Ray on the same scenes, in turn in one run.
//
// Prints a Markdown report; with --runs it also writes it, and the raw figures, to
// DIRECTORY/DATE-COMMIT.md and .json.

#include <fmt/format.h>
#include <hwy/targets.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <future>
#include <iostream>
#include <optional>
#include <set>
#include <thread>

#include "tests/measure/bench/measure_case.h"
#include "tests/measure/bench/report.h"
#include "tests/measure/report/command_text.h"
#include "tests/measure/report/written_file.h"

namespace {

using namespace raytracer;
using namespace raytracer::bench;

struct Options {
  std::vector<std::string> scenes;
  bool is_quick = false;
  bool without_embree = false;
  bool without_povray = false;
  bool is_avx2 = false;
  Effort effort;
  std::size_t threads = std::max(1U, std::thread::hardware_concurrency());
  std::string commit = "unknown";
  std::string runs;
  std::string pictures;
};

/// Returns the exit status where there is nothing more to do.
std::optional<int> parse_arguments(int argc, char** argv, Options& options) {
  CLI::App app{"Measures the project, Embree and POV-Ray on the same scenes, in turn."};
  std::set<std::string> names;
  for (const Case& each : all_cases()) names.insert(each.scene);
  app.add_option("--scene", options.scenes, "Only this scene; may be repeated")
      ->check(CLI::IsMember(names));
  app.add_flag("--quick", options.is_quick, "Only small scenes at 700 x 500 with one sample");
  app.add_flag("--no-embree", options.without_embree, "Leave Embree out");
  app.add_flag("--no-povray", options.without_povray, "Leave POV-Ray out");
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
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  return {};
}

bool is_wanted(const Case& candidate, const Options& options) {
  const bool is_named = options.scenes.empty() ||
                        std::find(options.scenes.begin(), options.scenes.end(), candidate.scene) !=
                            options.scenes.end();
  const bool is_small = candidate.is_quick && candidate.width == 700 && candidate.samples == 1;
  return is_named && (!options.is_quick || is_small);
}

void write_pictures(const CaseFigures& figures, const std::filesystem::path& directory,
                    WorkerPool& pool) {
  const auto write = [&](const ByteImage& image, const std::string& peer) {
    if (image.values.empty()) return;
    std::string name = figures.measured.name() + ", " + peer + ".png";
    std::replace(name.begin(), name.end(), ' ', '-');
    std::erase(name, ',');
    write_file(directory / name, encode(image, ImageFormat::png, pool));
  };
  write(figures.pictures.project, "project");
  write(figures.pictures.project_without_ambient, "project-without-ambient");
  write(figures.pictures.embree, "embree");
  write(figures.pictures.povray, "povray");
}

/// As DATE-COMMIT.md and .json.
void write_report(const Report& report, const std::filesystem::path& directory) {
  const std::string name = report.date + '-' + report.commit;
  write_file(directory / (name + ".md"), to_markdown(report));
  write_file(directory / (name + ".json"), to_json(report));
}

/// Measures every case that is wanted. Writes the report after each: a run takes long.
Report measure_all(const Options& options, const std::string& command) {
  // Before the engine asks what there is.
  if (options.is_avx2) hwy::SetSupportedTargetsForTest(HWY_AVX2 | HWY_SSE4 | HWY_SSSE3);
  WorkerPool pool(options.threads);
  const MachineCosts costs = measure_machine_costs(pool);
  std::optional<EmbreePeer> embree;
  std::optional<PovrayPeer> povray;
  Report report{.date = today(),
                .commit = options.commit,
                .command = command,
                .thread_count = options.threads,
                .machine = describe_machine()};
  if (!options.without_embree) {
    embree.emplace(pool);
    report.embree = fmt::format("{}, packets of {}", embree->version(), embree->packet_width());
  }
  if (!options.without_povray) {
    povray.emplace(options.threads);
    report.povray = PovrayPeer::version();
  }
  for (const Case& candidate : all_cases()) {
    if (!is_wanted(candidate, options)) continue;
    std::cerr << candidate.name() << std::endl;
    CaseFigures figures = measure(candidate, options.effort,
                                  {.pool = pool,
                                   .costs = costs,
                                   .embree = embree ? &*embree : nullptr,
                                   .povray = povray ? &*povray : nullptr});
    if (!options.pictures.empty()) write_pictures(figures, options.pictures, pool);
    figures.pictures = Pictures();
    report.cases.push_back(std::move(figures));
    if (!options.runs.empty()) write_report(report, options.runs);
  }
  return report;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Options options;
    if (const auto status = parse_arguments(argc, argv, options)) return *status;
    // Not by the main thread: jemalloc 5.3 makes its arena before it has read the options, and
    // gives back its blocks of 8 MB at once; most of the server's threads have others.
    const auto measure = [&] {
      return measure_all(options, command_text("raytracer_bench", argc, argv,
                                               {"--runs", "--pictures", "--commit"}));
    };
    std::cout << to_markdown(std::async(std::launch::async, measure).get());
  } catch (const std::exception& error) {
    std::cerr << "bench: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
