// The published trade: what accuracy costs the project and its peers; whether targets and budgets
// are kept.
//
// Prints a Markdown report; with --runs it also writes it, the raw figures and a drawing of error
// against time to DIRECTORY/DATE-COMMIT.md, .json and .svg.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <utility>

#include "tests/measure/report/command_text.h"
#include "tests/measure/report/print_measured.h"
#include "tests/measure/report/written_file.h"
#include "tests/measure/scenes/named_scene.h"
#include "tests/measure/scenes/untuned_scenes.h"
#include "tests/measure/tradeoff/report.h"
#include "tests/measure/tradeoff/trade_svg.h"

namespace {

using namespace raytracer;
using namespace raytracer::measure;
using namespace raytracer::published;
namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> scenes;
  std::vector<std::string> parts;
  bool is_quick = false;
  EqualErrorEffort effort{.targets = {0.01, 0.003, 0.001, 0.0005}};
  std::vector<double> contract_targets{0.03, 0.01, 0.003, 0.001, 0.0005};
  std::vector<double> budgets_ms{5, 20, 50, 100, 200};
  int contract_samples = 12'288;
  int budget_samples = 3072;
  int budget_repetitions = 20;
  double exact_seconds = 8;
  std::size_t threads = 2;
  std::string commit = "unknown";
  std::string runs;
  std::string shipped = "server/scenes";
};

/// Returns the exit status where there is nothing more to do.
std::optional<int> parse_arguments(int argc, char** argv, Options& options) {
  CLI::App app{"Measures what accuracy costs, beside other renderers, and what is kept of it."};
  app.add_option("--scene", options.scenes,
                 "Only this scene, in all parts: one that is made here, a shipped one, or a "
                 "document's path; may be repeated");
  app.add_option("--part", options.parts, "Only this part; may be repeated")
      ->check(CLI::IsMember({"equal-error", "contracts", "budgets"}));
  app.add_flag("--quick", options.is_quick,
               "Less of everything, for a look: fewer targets, samples and repetitions");
  app.add_option("--rounds", options.effort.rounds, "Rounds of each target at equal error")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--seconds", options.effort.seconds,
                 "After so long a target has no further round, if it had three")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--exact-seconds", options.exact_seconds,
                 "Targets: a scene whose exact picture takes longer is smaller, or left out")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--threads", options.threads, "Threads of every program")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--commit", options.commit, "What is measured, for the report");
  app.add_option("--runs", options.runs, "Write the report into this directory")
      ->check(CLI::ExistingDirectory);
  app.add_option("--shipped", options.shipped, "Where the shipped scenes are")
      ->check(CLI::ExistingDirectory)
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  if (options.is_quick) {
    options.effort.targets = {0.01, 0.003};
    options.effort.exact_samples = 3072;
    options.effort.rounds = 3;
    options.contract_samples = 3072;
    options.contract_targets = {0.03, 0.01, 0.003};
    options.exact_seconds = 2;
    options.budget_samples = 768;
    options.budget_repetitions = 3;
  }
  return {};
}

std::vector<NamedScene> named(const std::vector<std::string>& names, const Options& options) {
  std::vector<NamedScene> scenes;
  scenes.reserve(names.size());
  for (const std::string& name : names) scenes.push_back(find_scene(name, options.shipped));
  return scenes;
}

std::vector<NamedScene> contract_scenes(const Options& options) {
  std::vector<NamedScene> scenes = shipped_scenes(options.shipped);
  for (const auto& more : {untuned_scenes(), named({"random-1000", "sphereflake-7381", "mesh-4800",
                                                    "reflections", "square-500x500"},
                                                   options)})
    scenes.insert(scenes.end(), more.begin(), more.end());
  return scenes;
}

/// The scenes that are named, or those that `part` has by itself; none where it is not wanted.
std::vector<NamedScene> wanted(const Options& options, const std::string& part) {
  const auto& parts = options.parts;
  if (!parts.empty() && std::find(parts.begin(), parts.end(), part) == parts.end()) return {};
  if (!options.scenes.empty()) return named(options.scenes, options);
  if (part == "contracts") return contract_scenes(options);
  if (part == "budgets") return named({"demo", "mirrors", "mesh", "random-1000"}, options);
  return named({"two-spheres", "square-28x28", "square-80x80", "demo", "random-1000", "reflections",
                "mirrors", "mesh-4800", "haines-balls", "haines-gears", "haines-tetra", "sky-1000",
                "wide-sun-1000", "lamp-1000"},
               options);
}

/// As DATE-COMMIT.md, .json and, of the demo, .svg.
void write_report(const Report& report, const std::string& directory) {
  if (directory.empty()) return;
  const std::string name = report.head.date + '-' + report.head.commit;
  write_file(fs::path(directory) / (name + ".md"), to_markdown(report));
  write_file(fs::path(directory) / (name + ".json"), to_json(report));
  for (const EqualErrorFigures& figures : report.equal_error)
    if (figures.scene == "demo")
      write_file(fs::path(directory) / (name + ".svg"),
                 trade_svg(figures, report.head.thread_count));
}

/// Measures what is wanted. Writes the report after each scene: a run takes long.
Report measure_all(const Options& options, const std::string& command) {
  WorkerPool pool(options.threads);
  const auto all_peers = peers::all_peers(pool);
  Report report{.head = {.date = today(),
                         .commit = options.commit,
                         .command = command,
                         .thread_count = options.threads,
                         .machine = describe_machine()},
                .equal_error = {},
                .contracts = {},
                .skipped = {},
                .budgets = {}};
  for (const auto& peer : all_peers) report.head.peers.emplace_back(peer->name(), peer->version());
  for (const NamedScene& each : wanted(options, "equal-error")) {
    std::cerr << "equal error: " << each.name << std::endl;
    report.equal_error.push_back(measure_equal_error(each, options.effort, all_peers, pool));
    write_report(report, options.runs);
  }
  for (const NamedScene& each : wanted(options, "contracts")) {
    std::cerr << "targets: " << each.name << std::endl;
    auto figures = measure_contracts(each, options.contract_targets, options.contract_samples,
                                     options.exact_seconds, pool);
    if (figures)
      report.contracts.push_back(std::move(*figures));
    else
      report.skipped.push_back(each.name);
    write_report(report, options.runs);
  }
  const std::vector<NamedScene> budgets = wanted(options, "budgets");
  if (!budgets.empty()) {
    std::cerr << "budgets" << std::endl;
    report.budgets = measure_budgets(budgets, options.budgets_ms, options.budget_samples,
                                     options.budget_repetitions, pool);
    write_report(report, options.runs);
  }
  return report;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return print_measured(
      "published_tradeoff", [&] { return parse_arguments(argc, argv, options); },
      [&] {
        return to_markdown(measure_all(options, command_text("raytracer_published_tradeoff", argc,
                                                             argv, {"--runs", "--commit"})));
      });
}
