// Minutes of mixed traffic, and what the server still holds when it rests: memory, threads and
// descriptors of the last rest are those of the first, or something leaks.
//
// Under way they vary with who happens to be there, so they are compared at rests, where nobody is.
// The caches are small, so that they are full at the first. Needs /proc.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "tests/measure/soak/traffic.h"
#include "tests/process/process_figures.h"
#include "tests/process/server_process.h"

namespace {

using namespace raytracer::test;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int round_count = 5;
// A connection's thread ends after 5 s without one; the rest is for a machine that is busy.
constexpr std::chrono::seconds rest{12};

ProcessFigures figures_now(const ServerProcess& server) {
  if (const std::optional<ProcessFigures> figures = figures_of(server.id())) return *figures;
  throw std::runtime_error("the server is gone, or there is no /proc; its log:\n" + server.log());
}

void print(Clock::time_point begin, const char* state, const ProcessFigures& figures,
           const StatusCounts& counts) {
  std::string line;
  for (const auto& [status, count] : counts)
    line += fmt::format(" {}:{}", status == 0 ? "none" : fmt::format("{}", status), count);
  fmt::print("{:5.0f} s  {:7}  {:7} kB, {:4} threads, {:4} descriptors {}\n",
             std::chrono::duration<double>(Clock::now() - begin).count(), state,
             figures.resident_kb, figures.thread_count, figures.descriptor_count, line);
  std::fflush(stdout);
}

/// Every status was one that clients can be blamed for, or a success.
void judge(const StatusCounts& counts, std::vector<std::string>& complaints) {
  for (const auto& [status, count] : counts)
    if (status == 0 || status >= 500)
      complaints.push_back(fmt::format("{} answers were {}", count, status));
}

void judge(const ProcessFigures& first, const ProcessFigures& last,
           std::vector<std::string>& complaints) {
  constexpr std::int64_t noise_kb = 8 << 10;
  const std::int64_t allowed_kb = first.resident_kb + first.resident_kb / 20 + noise_kb;
  if (last.resident_kb > allowed_kb)
    complaints.push_back(
        fmt::format("memory grew from {} to {} kB", first.resident_kb, last.resident_kb));
  if (last.thread_count > first.thread_count)
    complaints.push_back(
        fmt::format("threads grew from {} to {}", first.thread_count, last.thread_count));
  if (last.descriptor_count > first.descriptor_count)
    complaints.push_back(fmt::format("descriptors grew from {} to {}", first.descriptor_count,
                                     last.descriptor_count));
}

int soak(std::chrono::seconds duration) {
  ServerProcess server({"--quiet", "--max-cache", "8000000", "--max-kept", "8000000"});
  std::vector<ProcessFigures> rests;
  std::vector<std::string> complaints;
  const auto begin = Clock::now();
  for (int round = 0; round < round_count; ++round) {
    StatusCounts counts;
    {
      const Traffic traffic(server, round);
      const auto end = begin + duration * (round + 1) / round_count - rest;
      do {
        std::this_thread::sleep_for(
            std::min<Clock::duration>(10s, std::max(end - Clock::now(), Clock::duration(1s))));
        print(begin, "traffic", figures_now(server), traffic.counts());
      } while (Clock::now() < end);
      counts = traffic.counts();
    }
    judge(counts, complaints);
    std::this_thread::sleep_for(rest);
    rests.push_back(figures_now(server));
    print(begin, "rest", rests.back(), {});
  }
  judge(rests.front(), rests.back(), complaints);
  fmt::print("peak {} kB\n", rests.back().peak_kb);
  server.signal(SIGTERM);
  const std::optional<int> status = server.wait();
  if (status != 0) complaints.push_back("the server did not end with status 0");
  for (const std::string& complaint : complaints) fmt::print("FAILED: {}\n", complaint);
  if (complaints.empty()) fmt::print("nothing leaks\n");
  return complaints.empty() ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) try {
  int seconds = 600;
  const std::string_view given = argc > 1 ? argv[1] : "600";
  const auto [end, error] = std::from_chars(given.data(), given.data() + given.size(), seconds);
  if (error != std::errc{} || end != given.data() + given.size() || seconds < 100 || argc > 2)
    throw std::runtime_error("usage: raytracer_soak [SECONDS], at least 100");
  return soak(std::chrono::seconds(seconds));
} catch (const std::exception& error) {
  std::fprintf(stderr, "raytracer_soak: %s\n", error.what());
  return EXIT_FAILURE;
}
