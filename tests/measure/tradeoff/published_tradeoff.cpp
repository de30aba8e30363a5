// The published trade: what accuracy costs the project, Embree and POV-Ray; whether targets and
// budgets are kept.
//
// Prints a Markdown report; with --runs it also writes it, the raw figures and a drawing of error
// against time to DIRECTORY/DATE-COMMIT.md, .json and .svg.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <future>
#include <iostream>
#include <iterator>
#include <optional>
#include <regex>
#include <set>
#include <stdexcept>
#include <utility>

#include "tests/measure/report/command_text.h"
#include "tests/measure/report/written_file.h"
#include "tests/measure/scenes/scene_documents.h"
#include "tests/measure/scenes/untuned_scenes.h"
#include "tests/measure/tradeoff/report.h"
#include "tests/measure/tradeoff/trade_svg.h"

namespace {

using namespace raytracer;
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
  CLI::App app{"Measures what accuracy costs, beside Embree and POV-Ray, and what is kept of it."};
  app.add_option("--scene", options.scenes, "Only this scene; may be repeated");
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

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return text;
}

/// With what all programs draw: no ambient light in shadows, no transfer.
std::string comparable_demo(const Options& options) {
  std::string text = text_of(fs::path(options.shipped) / "demo.json");
  text = std::regex_replace(text, std::regex(R"("shadows": "ambient")"), R"("shadows": "black")");
  return std::regex_replace(text, std::regex(R"("transfer": "srgb")"), R"("transfer": "linear")");
}

std::vector<EqualErrorCase> equal_error_cases(const Options& options) {
  return {{"two-spheres", bench::two_spheres()},
          {"square-28", bench::two_spheres_and_square(14)},
          {"square-80", bench::two_spheres_and_square(40)},
          {"demo", comparable_demo(options)}};
}

std::vector<ContractCase> contract_cases(const Options& options) {
  std::set<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(options.shipped))
    if (entry.path().extension() == ".json") paths.insert(entry.path());
  std::vector<ContractCase> cases;
  cases.reserve(paths.size());
  for (const fs::path& path : paths) cases.push_back({path.stem().string(), text_of(path), true});
  for (ContractCase& untuned : untuned_scenes()) cases.push_back(std::move(untuned));
  return cases;
}

std::vector<BudgetCase> budget_cases(const Options& options) {
  const auto shipped = [&](const char* name) {
    return BudgetCase{name, text_of(fs::path(options.shipped) / (std::string(name) + ".json"))};
  };
  return {shipped("demo"),
          shipped("mirrors"),
          shipped("mesh"),
          {"random-1000", bench::random_spheres(1000)}};
}

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

/// The cases of a part that are wanted.
template <typename Case>
std::vector<Case> wanted(const Options& options, const char* part, std::vector<Case> cases) {
  if (!is_among(options.parts, part)) return {};
  std::erase_if(cases, [&](const Case& each) { return !is_among(options.scenes, each.scene); });
  return cases;
}

/// As DATE-COMMIT.md, .json and, of the demo, .svg.
void write_report(const Report& report, const std::string& directory) {
  if (directory.empty()) return;
  const std::string name = report.date + '-' + report.commit;
  bench::write_file(fs::path(directory) / (name + ".md"), to_markdown(report));
  bench::write_file(fs::path(directory) / (name + ".json"), to_json(report));
  for (const EqualErrorFigures& figures : report.equal_error)
    if (figures.scene == "demo")
      bench::write_file(fs::path(directory) / (name + ".svg"),
                        trade_svg(figures, report.equal_error_size, report.thread_count));
}

/// Measures what is wanted. Writes the report after each scene: a run takes long.
Report measure_all(const Options& options, const std::string& command) {
  WorkerPool pool(options.threads);
  bench::EmbreePeer embree(pool);
  bench::PovrayPeer povray(options.threads);
  Report report{.date = bench::today(),
                .commit = options.commit,
                .command = command,
                .thread_count = options.threads,
                .machine = bench::describe_machine(),
                .embree = fmt::format("{}, packets of {}", embree.version(), embree.packet_width()),
                .povray = bench::PovrayPeer::version(),
                .equal_error_size = {},
                .equal_error = {},
                .contracts = {},
                .skipped = {},
                .budgets = {}};
  for (const EqualErrorCase& each : wanted(options, "equal-error", equal_error_cases(options))) {
    std::cerr << "equal error: " << each.scene << std::endl;
    report.equal_error.push_back(
        measure_equal_error(each, report.equal_error_size, options.effort, pool, embree, povray));
    write_report(report, options.runs);
  }
  for (const ContractCase& each : wanted(options, "contracts", contract_cases(options))) {
    std::cerr << "targets: " << each.scene << std::endl;
    auto figures = measure_contracts(each, options.contract_targets, options.contract_samples,
                                     options.exact_seconds, pool);
    if (figures)
      report.contracts.push_back(std::move(*figures));
    else
      report.skipped.push_back(each.scene);
    write_report(report, options.runs);
  }
  const auto budgets = wanted(options, "budgets", budget_cases(options));
  if (!budgets.empty()) {
    std::cerr << "budgets" << std::endl;
    report.budgets = measure_budgets(budgets, options.budgets_ms, options.budget_samples,
                                     options.budget_repetitions, pool);
    write_report(report, options.runs);
  }
  if (report.equal_error.empty() && report.contracts.empty() && report.budgets.empty())
    throw std::runtime_error("nothing was measured: no such scene in the parts that are wanted");
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
      return measure_all(options, bench::command_text("raytracer_published_tradeoff", argc, argv,
                                                      {"--runs", "--commit"}));
    };
    std::cout << to_markdown(std::async(std::launch::async, measure).get());
  } catch (const std::exception& error) {
    std::cerr << "published_tradeoff: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
