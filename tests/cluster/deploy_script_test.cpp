// server/deploy/cluster: one command starts everything, and ends everything.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <map>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include "tests/cluster/balancer.h"
#include "tests/cluster/nats_server.h"
#include "tests/process/patience.h"
#include "tests/process/program.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

/// The script with the programs under test; ended, not killed, so that nothing stays behind.
class Script {
 public:
  explicit Script(std::vector<std::string> arguments,
                  std::map<std::string, std::string> environment = {})
      : process_({script_of(tree_), std::move(arguments), {}, std::move(environment)}) {}
  ~Script() {
    process_.signal(SIGTERM);
    process_.wait(40s);
  }
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;

  bool is_ready() {
    return eventually([this] { return says("Ctrl-C ends") || process_.wait({}).has_value(); },
                      60s) &&
           says("Ctrl-C ends");
  }
  bool says(const std::string& text) const {
    return process_.out().find(text) != std::string::npos;
  }
  /// The first group of each match in what it said.
  std::vector<std::string> found(const std::string& pattern) const {
    const std::string said = process_.out();
    const std::regex expression(pattern);
    std::vector<std::string> groups;
    for (std::sregex_iterator match(said.begin(), said.end(), expression), end; match != end;
         ++match)
      groups.push_back(match->str(1));
    return groups;
  }
  Process& process() { return process_; }

 private:
  static fs::path script_of(const TemporaryFolder& tree) {
    fs::create_directory(tree / "build");
    fs::create_symlink(RAYTRACER_SERVER_PATH, tree / "build/raytracer-server");
    fs::create_symlink(fs::path(RAYTRACER_SOURCE_DIR) / "server", tree / "server");
    return tree / "server/deploy/cluster";
  }

  const TemporaryFolder tree_;
  Process process_;
};

class DeployScript : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_balancer() || NatsServer::program().empty())
      GTEST_SKIP() << "haproxy or nats-server is not installed: .ci/install cluster";
  }
};

bool runs(const std::string& process) { return ::kill(std::stoi(process), 0) == 0; }

TEST_F(DeployScript, starts_all_parts_and_leaves_none) {
  Script script({"--workers", "3", "--threads", "1"});
  ASSERT_TRUE(script.is_ready()) << script.process().out() << script.process().err();
  const std::vector<std::string> parts = script.found(R"(\n  \w+ +(\d+))");
  EXPECT_EQ(parts.size(), 7U) << "NATS, three workers, two fronts, HAProxy";
  for (const std::string& part : parts) EXPECT_TRUE(runs(part)) << part;
  const Outcome table =
      run({RAYTRACER_CLIENT_PATH, {"cluster", "--server", script.found("at (http\\S+)").at(0)}});
  EXPECT_EQ(table.status, 0) << table.err;
  EXPECT_EQ(std::count(table.out.begin(), table.out.end(), '\n'), 7) << table.out;
  const std::string folder = script.found("says is in (\\S+)\\.").at(0);
  EXPECT_TRUE(fs::exists(folder));

  script.process().signal(SIGTERM);
  EXPECT_EQ(script.process().wait(40s), 143) << script.process().err();
  for (const std::string& part : parts) EXPECT_FALSE(runs(part)) << part;
  EXPECT_FALSE(fs::exists(folder));
}

TEST_F(DeployScript, says_which_part_has_ended_and_goes_on) {
  // Whoever tries a cluster may have these for another one.
  Script script({"--workers", "1"}, {{"RAYTRACER_TOKEN", "of-another"},
                                     {"RAYTRACER_PORT", "1"},
                                     {"NATS_CREDS", "/of/another"},
                                     {"FRONT_3", "of another"}});
  ASSERT_TRUE(script.is_ready()) << script.process().out() << script.process().err();
  ::kill(std::stoi(script.found(R"(worker1 +(\d+))").at(0)), SIGKILL);
  EXPECT_TRUE(eventually([&] { return script.says("worker1 has ended with status 137"); }));
  std::this_thread::sleep_for(500ms);
  EXPECT_FALSE(script.process().wait(0ms).has_value());
}

TEST_F(DeployScript, part_that_does_not_start_is_named_with_its_log_and_none_is_left) {
  const ServerProcess other;  // which has the port
  const TemporaryFolder kept;
  Script script({"--port", std::to_string(other.port()), "--keep", kept.path().string()});
  EXPECT_EQ(script.process().wait(60s), 1);
  const std::string said = script.process().err();
  EXPECT_NE(said.find("haproxy did not start"), std::string::npos) << said;
  EXPECT_NE(said.find("Address already in use"), std::string::npos) << said;
  EXPECT_FALSE(script.says("The service is at"));
  std::smatch port;
  const std::string log = read_file(kept / "nats.log");
  ASSERT_TRUE(std::regex_search(log, port, std::regex(R"(127\.0\.0\.1:(\d+))"))) << log;
  EXPECT_EQ(httplib::Client("127.0.0.1", std::stoi(port[1])).Get("/").error(),
            httplib::Error::Connection);
}

TEST_F(DeployScript, wrong_arguments_are_refused_before_anything_starts) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--workers", "0"},
                                                    {"--workers"},
                                                    {"--keep"},
                                                    {"--no-such-flag"}}) {
    Script script(arguments);
    EXPECT_EQ(script.process().wait(10s), 1);
    EXPECT_NE(script.process().err().find("usage: cluster"), std::string::npos);
  }
}

}  // namespace
}  // namespace raytracer::test
