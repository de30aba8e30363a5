// How long a large picture takes on a cluster, beside servers alone that have as many threads, in
// turn: and whether it has the same bytes. The front leaves the work to workers of one thread.
//
// Wall time: whatever else runs on this machine is in it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/measure/stopwatch.h"
#include "tests/measure/cluster/jobs.h"
#include "tests/measure/cluster/nats.h"
#include "tests/measure/report/markdown_table.h"
#include "tests/measure/report/median.h"
#include "tests/process/server_process.h"

namespace {

using namespace raytracer;
using namespace raytracer::measure;
using Server = test::ServerProcess;

struct Options {
  int rounds = 11;
  std::string job = "scene=square-500&width=1920&height=1080&samples=64";
  std::size_t workers = 3;
};

/// NATS, a front without work and some workers.
class Cluster {
 public:
  explicit Cluster(std::size_t worker_count) {
    const std::vector<std::string> flags{"--nats", nats_.url(), "--threads", "1", "--quiet"};
    const auto with = [&](const char* flag) {
      std::vector<std::string> all = flags;
      all.emplace_back(flag);
      return all;
    };
    front_ = std::make_unique<Server>(with("--no-work"));
    for (std::size_t i = 0; i < worker_count; ++i)
      workers_.push_back(std::make_unique<Server>(with("--worker")));
    await_workers(*front_, worker_count);
  }
  const Server& front() const { return *front_; }

 private:
  const Nats nats_;
  std::unique_ptr<Server> front_;
  std::vector<std::unique_ptr<Server>> workers_;
};

struct Made {
  double ms;
  std::string picture;
};

Made make(const Server& server, const std::string& query) {
  const Stopwatch stopwatch;
  const std::string job = begin_job(server, query);
  await_end(server, job);
  const double ms = stopwatch.elapsed_ms();
  Made made{ms, get(server, job + "/image")};
  server.client().Delete(job);
  return made;
}

/// A server alone and a cluster with as many threads.
struct Pair {
  explicit Pair(std::size_t threads)
      : alone({"--threads", std::to_string(threads), "--quiet"}), cluster(threads) {}
  const Server alone;
  const Cluster cluster;
  std::vector<double> alone_ms{}, cluster_ms{}, ratios{};
};

/// One picture by all; each round's is another one, so that nobody has any part of it.
void run_round(const Options& options, std::vector<std::unique_ptr<Pair>>& pairs, int round) {
  const std::string query = fmt::format("{}&max_depth={}", options.job, 1 + round % 60);
  std::string picture;
  const auto expect_same = [&](const Made& made) {
    if (picture.empty()) picture = made.picture;
    if (made.picture != picture) throw std::runtime_error(query + ": not the same bytes");
  };
  for (const auto& pair : pairs) {
    const auto time = [&](const Server& server, std::vector<double>& all_ms) {
      const Made made = make(server, query);
      expect_same(made);
      all_ms.push_back(made.ms);
    };
    const bool is_alone_first = round % 2 == 0;
    if (is_alone_first) time(pair->alone, pair->alone_ms);
    time(pair->cluster.front(), pair->cluster_ms);
    if (!is_alone_first) time(pair->alone, pair->alone_ms);
    pair->ratios.push_back(pair->cluster_ms.back() / pair->alone_ms.back());
  }
}

void compare(const Options& options) {
  std::vector<std::unique_ptr<Pair>> pairs;
  for (std::size_t threads = 1; threads <= options.workers; ++threads)
    pairs.push_back(std::make_unique<Pair>(threads));
  for (int round = 0; round < options.rounds; ++round) run_round(options, pairs, round);
  std::cout << row("threads", "alone, ms", "workers of one thread, ms", "median of ratios")
            << "|--:|--:|--:|--:|\n";
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Pair& pair = *pairs[i];
    std::cout << row(i + 1, digits(median(pair.alone_ms)), digits(median(pair.cluster_ms)),
                     fmt::format("{:.3f}", median(pair.ratios)));
  }
  std::cout << fmt::format("{} pictures, each with the same bytes from all\n", options.rounds);
}

}  // namespace

int main(int argc, char** argv) try {
  Options options;
  CLI::App app{"A large picture from clusters and from servers alone, in turn."};
  app.add_option("--rounds", options.rounds, "Pictures of each")->check(CLI::Range(1, 60));
  app.add_option("--job", options.job, "Query of the picture");
  app.add_option("--workers", options.workers, "Of the largest cluster")->check(CLI::Range(1, 64));
  CLI11_PARSE(app, argc, argv);
  compare(options);
} catch (const std::exception& error) {
  std::cerr << "raytracer_cluster_speed: " << error.what() << '\n';
  return 1;
}
