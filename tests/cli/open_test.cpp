// The page of a server that keeps the scene, and the browser that is started for it.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "tests/cli/client.h"
#include "tests/process/patience.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

class Open : public Client {};

TEST_F(Open, scene_is_kept_where_the_page_finds_it) {
  const TemporaryFolder folder;
  const std::string file = folder.write("atom.xyz", "1\n\nC 0 0 0\n");
  const Outcome outcome = run_with_server({"open", file});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string before = server().url() + "/#scene=";
  ASSERT_TRUE(outcome.out.starts_with(before)) << outcome.out;
  const std::string id = outcome.out.substr(before.size(), 32);
  const auto kept = server().client().Get("/scenes/" + id);
  ASSERT_TRUE(kept);
  EXPECT_EQ(nlohmann::json::parse(kept->body),
            nlohmann::json::parse(run_client({"convert", file}).out));
}

TEST_F(Open, private_server_stays_until_it_is_interrupted) {
  Process process(client_command({"open", "demo"}));
  ASSERT_TRUE(eventually([&] { return process.out().ends_with("\n"); })) << process.err();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_FALSE(process.wait(std::chrono::milliseconds(0)));
  process.signal(SIGINT);
  EXPECT_EQ(process.wait(std::chrono::milliseconds(5000)), 130);
}

#ifdef __linux__
/// Of what a process's status has under `name`, a bit for each signal.
bool has_signal(const std::string& status, const std::string& name, int signal) {
  const std::string field = name + ":\t";
  const std::uint64_t signals =
      std::stoull(status.substr(status.find(field) + field.size()), nullptr, 16);
  return (signals >> (signal - 1) & 1) != 0;
}

/// Whatever else the shell ignores.
TEST_F(Open, browser_starts_as_from_a_shell) {
  const TemporaryFolder folder;
  const std::string browser = folder.write("browser", R"(#!/bin/sh
grep -E '^Sig(Blk|Ign)' /proc/self/status >"$0.part"
echo "$1" >>"$0.part"
mv "$0.part" "$0.signals"
)");
  std::filesystem::permissions(browser, std::filesystem::perms::owner_all);
  const Outcome outcome = run_client({"open", "demo"}, "",
                                     {{"RAYTRACER_SERVER", server().url()}, {"BROWSER", browser}});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string signals = browser + ".signals";
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(signals); }));
  const std::string status = read_file(signals);
  EXPECT_TRUE(status.ends_with("\n" + outcome.out)) << status;
  for (const int signal : {SIGHUP, SIGINT, SIGTERM})
    EXPECT_FALSE(has_signal(status, "SigBlk", signal)) << status;
  EXPECT_FALSE(has_signal(status, "SigIgn", SIGPIPE)) << status;
}
#endif

}  // namespace
}  // namespace raytracer::test
