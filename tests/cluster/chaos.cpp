// Kills workers, fronts and NATS with -9 at random moments while jobs run, and starts them again:
// every job that was accepted has to end, with the right bytes, each task counted once, and nothing
// may be left in the store. Exits with 1 if something is not so, with 77 without nats-server.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <cstdio>
#include <random>
#include <thread>

#include "tests/cluster/chaos_clients.h"
#include "tests/cluster/chaos_cluster.h"
#include "tests/cluster/stored.h"
#include "tests/process/patience.h"

namespace {

using namespace raytracer;
using namespace raytracer::test;
using namespace std::chrono_literals;

constexpr int skipped = 77;

struct Options {
  int rounds = 200;
  unsigned seed = 1;
  int keep_s = 60;
};

std::array<int, 3> run_rounds(const Options& options, ChaosCluster& cluster,
                              const ChaosClients& clients) {
  std::mt19937 random(options.seed);
  const auto at_most = [&](int ms) { return std::chrono::milliseconds(random() % ms); };
  std::array<int, 3> kills{};
  const auto kill_one = [&](std::size_t part) {
    cluster.kill(static_cast<Part>(part), random);
    ++kills[part];
  };
  for (int round = 0; round < options.rounds && clients.faults().empty(); ++round) {
    std::this_thread::sleep_for(at_most(600));
    const std::size_t part = static_cast<std::size_t>(round) % kills.size();
    kill_one(part);
    if (random() % 4 == 0) {  // another beside it
      std::this_thread::sleep_for(at_most(100));
      kill_one((part + 1) % kills.size());
    }
    std::this_thread::sleep_for(at_most(500));
    cluster.restart();
    // It goes on.
    const int before = clients.ended();
    if (!eventually([&] { return clients.ended() > before || !clients.faults().empty(); }, 60s))
      break;
  }
  return kills;
}

/// What is still stored when everything should be forgotten.
std::vector<std::string> leftovers(const Options& options, const ChaosCluster& cluster) {
  Stored stored(cluster.nats_url());
  std::vector<std::string> left;
  eventually(
      [&] {
        left = stored.of_jobs();
        for (const std::string& subject : stored.connection.subjects("raytracer_scenes", ">"))
          left.push_back(subject);
        return left.empty();
      },
      std::chrono::seconds(options.keep_s + 20));
  return left;
}

int run(const Options& options) {
  if (NatsServer::program().empty()) {
    std::puts("nats-server is not installed");
    return skipped;
  }
  // A job that is not done by then is forgotten as well.
  ChaosCluster cluster(std::chrono::duration_cast<std::chrono::seconds>(
      patience(std::chrono::seconds(options.keep_s))));
  ChaosClients clients(cluster, chaos_pictures(), options.seed);
  const auto kills = run_rounds(options, cluster, clients);
  clients.finish();
  fmt::print("killed: {} workers, {} fronts, {} times NATS; {} jobs accepted, {} ended well\n",
             kills[0], kills[1], kills[2], clients.accepted(), clients.ended());
  for (const std::string& fault : clients.faults()) fmt::print("fault: {}\n", fault);
  const std::vector<std::string> left = leftovers(options, cluster);
  fmt::print("left in the store {} s later: {}\n", options.keep_s, left.size());
  for (const std::string& subject : left) fmt::print("  {}\n", subject);
  const bool is_well =
      clients.faults().empty() && left.empty() && clients.accepted() == clients.ended();
  if (!is_well) fmt::print(stderr, "{}", cluster.log());
  return is_well ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) try {
  Options options;
  CLI::App app("Kills parts of a cluster while it works");
  app.add_option("--rounds", options.rounds, "How often something is killed")
      ->check(CLI::Range(1, 100'000));
  app.add_option("--seed", options.seed, "Of when and what");
  app.add_option("--keep", options.keep_s, "Seconds after which jobs are forgotten")
      ->check(CLI::Range(5, 3600));
  CLI11_PARSE(app, argc, argv);
  return run(options);
} catch (const std::exception& error) {
  std::fprintf(stderr, "raytracer_cluster_chaos: %s\n", error.what());
  return EXIT_FAILURE;
}
