// What a server without --nats pays for the cluster that it does not use: beside a server of
// another build, such as the same source before a change. Its file, its memory at rest and its
// small renders, in turn.
#include <fmt/format.h>
#include <httplib.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/measure/stopwatch.h"
#include "tests/measure/report/markdown_table.h"
#include "tests/measure/report/median.h"
#include "tests/process/patience.h"
#include "tests/process/program.h"

namespace {

using namespace raytracer;
using namespace raytracer::measure;

struct Options {
  std::string other;
  int rounds = 31;
  int renders = 200;
};

/// A server of any build, alone.
class Alone {
 public:
  explicit Alone(const std::string& program)
      : program_(program), process_({program, {"--port", "0", "--threads", "1", "--quiet"}}) {
    static const std::regex greeting(R"(listening on http://127.0.0.1:(\d+))");
    std::smatch match;
    std::string said;
    const bool listens = test::eventually([&] {
      said = process_.out();
      return std::regex_search(said, match, greeting);
    });
    if (!listens) throw std::runtime_error(program + " does not listen: " + process_.err());
    client_ = std::make_unique<httplib::Client>("127.0.0.1", std::stoi(match[1]));
    client_->set_keep_alive(true);
  }

  double file_kb() const { return static_cast<double>(std::filesystem::file_size(program_)) / 1e3; }

  /// What is its own of the memory that it has, and what it shares with others by its part of it.
  double memory_kb() const {
    std::ifstream file(fmt::format("/proc/{}/smaps_rollup", process_.id()));
    for (std::string line; std::getline(file, line);)
      if (line.starts_with("Pss:")) return std::stod(line.substr(4));
    throw std::runtime_error("the system does not say how much memory a process has");
  }

  /// Milliseconds for each of so many renders that no cache answers.
  double render_ms(int renders) const {
    const Stopwatch stopwatch;
    for (int i = 0; i < renders; ++i) {
      const auto answer = client_->Get("/render?scene=first-sphere&width=96&height=72",
                                       {{"Cache-Control", "no-cache"}});
      if (!answer || answer->status != 200) throw std::runtime_error("a render failed");
    }
    return stopwatch.elapsed_ms() / renders;
  }

 private:
  std::string program_;
  test::Process process_;
  std::unique_ptr<httplib::Client> client_;
};

void compare(const Options& options) {
  const Alone here(RAYTRACER_SERVER_PATH), other(options.other);
  const double here_kb = here.memory_kb(), other_kb = other.memory_kb();
  std::vector<double> here_ms, other_ms, ratios;
  for (int round = 0; round < options.rounds; ++round) {
    const bool is_first = round % 2 == 0;
    if (is_first) here_ms.push_back(here.render_ms(options.renders));
    other_ms.push_back(other.render_ms(options.renders));
    if (!is_first) here_ms.push_back(here.render_ms(options.renders));
    ratios.push_back(here_ms.back() / other_ms.back());
  }
  std::cout << row("", "here", "other", "difference") << "|---|--:|--:|--:|\n"
            << row("file, kB", digits(here.file_kb()), digits(other.file_kb()),
                   digits(here.file_kb() - other.file_kb()))
            << row("memory at rest, kB", digits(here_kb), digits(other_kb),
                   digits(here_kb - other_kb))
            << row("a small render, ms", fmt::format("{:.4f}", median(here_ms)),
                   fmt::format("{:.4f}", median(other_ms)),
                   fmt::format("{:.3f} times", median(ratios)));
}

}  // namespace

int main(int argc, char** argv) try {
  Options options;
  CLI::App app{"A server alone, beside one of another build."};
  app.add_option("OTHER", options.other, "The other raytracer-server")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--rounds", options.rounds, "In turn")->check(CLI::Range(1, 1000));
  app.add_option("--renders", options.renders, "In each round")->check(CLI::Range(1, 100'000));
  CLI11_PARSE(app, argc, argv);
  compare(options);
} catch (const std::exception& error) {
  std::cerr << "raytracer_cluster_alone: " << error.what() << '\n';
  return 1;
}
