// Small renders through HAProxy before three servers of one thread: whether one fails while a
// server is killed and another is drained, and how many a second three answer, beside one.
//
// Wall time: whatever else runs on this machine is in it, HAProxy and the clients as well.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <exception>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/measure/stopwatch.h"
#include "tests/cluster/balancer.h"
#include "tests/cluster/traffic.h"
#include "tests/measure/report/markdown_table.h"
#include "tests/measure/report/median.h"

namespace {

using namespace raytracer;
using namespace raytracer::measure;
using Servers = std::vector<std::unique_ptr<test::ServerProcess>>;

struct Options {
  int requests = 20'000;
  int rounds = 7;
  int connections = 16;
};

/// Named so that they are spread over all servers; rendered each time.
httplib::Result small_render(httplib::Client& client, int number) {
  return client.Get(
      fmt::format("/render?scene=first-sphere&width=96&height=72&max_depth={}", number % 48),
      {{"Cache-Control", "no-cache"}, {"Scene-Digest", std::to_string(number % 48)}});
}

Servers start(int count) {
  Servers servers;
  for (int i = 0; i < count; ++i)
    servers.push_back(std::make_unique<test::ServerProcess>(
        std::vector<std::string>{"--threads", "1", "--quiet", "--drain-delay", "1500"}));
  return servers;
}

void go_on(const test::Traffic& traffic, int count) {
  while (count > 0) {
    constexpr int at_once = 1000;
    if (!traffic.go_on(std::min(count, at_once))) throw std::runtime_error("nobody answers");
    count -= at_once;
  }
}

void lose_two(const Options& options) {
  const Servers servers = start(3);
  const test::Balancer balancer(servers);
  test::Traffic traffic(
      options.connections, [&] { return balancer.client(); }, small_render);
  go_on(traffic, options.requests / 3);
  servers[0]->signal(SIGKILL);
  go_on(traffic, options.requests / 3);
  servers[1]->signal(SIGTERM);
  const auto status = servers[1]->wait();
  go_on(traffic, options.requests - 2 * (options.requests / 3));
  const std::string failed = traffic.end();
  std::cout << fmt::format("{} requests, one server killed, one drained (status {}), {} failed\n{}",
                           traffic.answered(), status.value_or(-1),
                           std::count(failed.begin(), failed.end(), '\n'), failed);
  if (!failed.empty() || status != 0) throw std::runtime_error("not as promised");
}

double answers_a_second(const Options& options, const test::Balancer& balancer) {
  test::Traffic traffic(
      options.connections, [&] { return balancer.client(); }, small_render);
  constexpr int warm_up = 200, counted = 2000;
  go_on(traffic, warm_up);
  const int before = traffic.answered();
  const Stopwatch stopwatch;
  go_on(traffic, counted);
  const double ms = stopwatch.elapsed_ms();
  const double answers = traffic.answered() - before;
  traffic.end();
  return 1000 * answers / ms;
}

void compare(const Options& options) {
  const Servers one = start(1), three = start(3);
  const test::Balancer before_one(one), before_three(three);
  std::vector<double> of_one, of_three, ratios;
  for (int round = 0; round < options.rounds; ++round) {
    of_one.push_back(answers_a_second(options, before_one));
    of_three.push_back(answers_a_second(options, before_three));
    ratios.push_back(of_three.back() / of_one.back());
  }
  std::cout << row("one server, answers/s", "three servers, answers/s", "median of ratios")
            << "|--:|--:|--:|\n"
            << row(digits(median(of_one)), digits(median(of_three)),
                   fmt::format("{:.2f}", median(ratios)));
}

}  // namespace

int main(int argc, char** argv) try {
  Options options;
  CLI::App app{"Small renders through HAProxy, while servers end, and how many a second."};
  app.add_option("--requests", options.requests, "While servers end")
      ->check(CLI::Range(300, 10'000'000));
  app.add_option("--rounds", options.rounds, "One server against three")->check(CLI::Range(1, 99));
  app.add_option("--connections", options.connections, "At once")->check(CLI::Range(1, 256));
  CLI11_PARSE(app, argc, argv);
  if (!test::has_balancer()) throw std::runtime_error("there is no haproxy: .ci/install cluster");
  lose_two(options);
  compare(options);
} catch (const std::exception& error) {
  std::cerr << "raytracer_cluster_balanced: " << error.what() << '\n';
  return 1;
}
