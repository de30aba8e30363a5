// Without --server the client has a daemon of its own, which does not outlive it.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <system_error>
#include <vector>

#include "tests/cli/client.h"
#include "tests/golden/picture.h"
#include "tests/process/patience.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// The children of a process by their ids, as Linux tells them.
std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> children;
  const fs::path tasks = fs::path("/proc") / std::to_string(parent) / "task";
  std::error_code gone;
  for (const auto& task : fs::directory_iterator(tasks, gone)) {
    std::ifstream list(task.path() / "children");
    for (pid_t child = 0; list >> child;) children.push_back(child);
  }
  return children;
}

bool runs(pid_t pid) { return ::kill(pid, 0) == 0; }

TEST(PrivateDaemon, renders_without_any_server) {
  const Outcome outcome = run_client({"render", "-"}, small_scene);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(decode_png(outcome.out).width, 16);
}

TEST(PrivateDaemon, takes_work_that_would_keep_others_waiting) {
  const std::string large =
      R"({"objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1}],
          "camera": {"origin": [0, 0, 5], "look_at": [0, 0, 0], "fov": 1, "width": 10000,
                     "height": 8000}, "render": {"samples": 65536}})";
  EXPECT_EQ(run_client({"validate", "-"}, large).out, "standard input: valid\n");
  expect_input_error(run_client({"validate", "-"}, large, {{"RAYTRACER_MAX_WORK", "1000000"}}),
                     "(--max-work)");
}

/// They are meant for a daemon of one's own, but for its limits: with most the private one would
/// end, or be none that the client reaches.
TEST(PrivateDaemon, heeds_no_variable_of_a_server_for_others) {
  const std::string help = run({RAYTRACER_SERVER_PATH, {"--help"}}).out;
  const std::regex in_help(R"(\(or (RAYTRACER_\w+)\))");
  const std::regex limit("RAYTRACER_(THREADS|QUIET|MAX_(?!STORED).*)");
  std::map<std::string, std::string> environment;
  for (std::sregex_iterator i(help.begin(), help.end(), in_help), end; i != end; ++i)
    if (const std::string name = (*i)[1]; !std::regex_match(name, limit))
      environment[name] = "none";
  EXPECT_GT(environment.size(), 9U) << help;
  const Outcome outcome = run_client({"scenes"}, "", environment);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST(PrivateDaemon, is_found_on_path_and_its_lack_explained) {
  const TemporaryFolder folder;
  fs::copy_file(RAYTRACER_CLIENT_PATH, folder / "raytracer");
  const auto scenes_with_path = [&](const std::string& path) {
    return run({folder / "raytracer", {"scenes"}, "", {{"PATH", path}}});
  };
  const Outcome without = scenes_with_path(folder.path());
  EXPECT_EQ(without.status, 2);
  EXPECT_NE(without.err.find("raytracer-server"), std::string::npos) << without.err;
  EXPECT_NE(without.err.find("--server"), std::string::npos) << without.err;
  const fs::path server = RAYTRACER_SERVER_PATH;
  EXPECT_EQ(scenes_with_path(server.parent_path()).status, 0);
}

TEST(PrivateDaemon, that_cannot_start_is_status_2_with_its_reason) {
  const Outcome outcome = run_client({"scenes"}, "", {{"RAYTRACER_THREADS", "none"}});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("RAYTRACER_THREADS"), std::string::npos) << outcome.err;
}

#ifdef __linux__
/// A client in the middle of an endless render, and its daemon's process id.
class EndlessRender : public testing::Test {
 protected:
  EndlessRender() : client_(client_command({"render", "-"}, endless_scene())) {
    EXPECT_TRUE(eventually([&] {
      const std::vector<pid_t> children = children_of(client_.id());
      if (!children.empty()) daemon_ = children.front();
      return daemon_ > 0;
    }));
  }
  Process client_;
  pid_t daemon_ = -1;
};

TEST_F(EndlessRender, daemon_ends_when_the_client_is_asked_to) {
  client_.signal(SIGTERM);
  EXPECT_EQ(client_.wait(10s), 128 + SIGTERM);
  EXPECT_TRUE(eventually([&] { return !runs(daemon_); }, 3s));
}

TEST_F(EndlessRender, daemon_ends_when_the_client_is_killed) {
  client_.signal(SIGKILL);
  EXPECT_EQ(client_.wait(10s), 128 + SIGKILL);
  EXPECT_TRUE(eventually([&] { return !runs(daemon_); }, 3s));
}

TEST_F(EndlessRender, daemon_that_is_killed_is_status_2) {
  ::kill(daemon_, SIGKILL);
  EXPECT_EQ(client_.wait(10s), 2) << client_.err();
  EXPECT_TRUE(client_.err().ends_with("signal 9 (Killed)\n")) << "says more: " << client_.err();
}

TEST(PrivateDaemon, is_gone_after_a_render) {
  // By time, so that the daemon is seen however fast the engine is.
  Process client(client_command(
      {"render", "-", "--width", "700", "--height", "500", "--budget-ms", "500"}, small_scene));
  pid_t daemon = -1;
  ASSERT_TRUE(eventually([&] {
    const std::vector<pid_t> children = children_of(client.id());
    if (!children.empty()) daemon = children.front();
    return daemon > 0 || client.wait(0ms).has_value();
  }));
  EXPECT_EQ(client.wait(10s), 0) << client.err();
  ASSERT_GT(daemon, 0);
  EXPECT_FALSE(runs(daemon));
}
#endif

}  // namespace
}  // namespace raytracer::test
