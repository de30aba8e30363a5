// `animate` and a server's queue: as many frames at a time as it takes, and patience with others.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/client.h"
#include "tests/process/patience.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

class Shooting : public testing::Test {
 protected:
  /// Goes round a scene.
  Command turn(const ServerProcess& server, const std::string& scene, int frames,
               const std::vector<std::string>& accuracy = {}) const {
    std::vector<std::string> arguments{"animate",     folder_.write("scene.json", scene),
                                       "--turntable", std::to_string(frames),
                                       "--server",    server.url(),
                                       "-o",          folder_ / "turn-%d.png"};
    arguments.insert(arguments.end(), accuracy.begin(), accuracy.end());
    return client_command(arguments);
  }

  /// How often the server has been asked for a job.
  static int asked(const ServerProcess& server) {
    const std::string log = server.log();
    int count = 0;
    for (std::size_t at = 0; (at = log.find("POST /jobs", at)) != log.npos; ++at) ++count;
    return count;
  }

  const TemporaryFolder folder_;
};

TEST_F(Shooting, as_many_frames_are_under_way_as_the_server_takes) {
  const ServerProcess server({"--threads", "1"});
  Process client(turn(server, endless_scene(), 40));
  EXPECT_TRUE(eventually([&] { return asked(server) == 40; })) << asked(server);
  client.signal(SIGINT);
  EXPECT_EQ(client.wait(10s), 128 + SIGINT);
}

TEST_F(Shooting, frames_wait_while_the_queue_is_full) {
  const ServerProcess server({"--threads", "1", "--max-queue", "2"});
  const Outcome outcome = run(turn(server, small_scene, 20, {"--budget-ms", "20"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("20 frames written"), std::string::npos) << outcome.err;
}

TEST_F(Shooting, frames_before_one_that_is_refused_are_written) {
  const ServerProcess server({"--threads", "1", "--max-objects", "3"});
  std::string text;
  for (const int atoms : {1, 1, 5, 1}) {
    text += std::to_string(atoms) + "\n\n";
    for (int i = 0; i < atoms; ++i) text += "C " + std::to_string(9 * i) + " 0 0\n";
  }
  const Outcome outcome =
      run(client_command({"animate", folder_.write("film.xyz", text), "--frames", "all", "--server",
                          server.url(), "-o", folder_ / "part-%d.png"}));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("--max-objects"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("2 frames written"), std::string::npos) << outcome.err;
}

TEST_F(Shooting, waits_while_others_have_the_whole_server) {
  const ServerProcess server({"--threads", "1", "--max-queue", "0"});
  httplib::Client http = server.client();
  std::vector<std::string> others;
  for (int i = 0; i < 4; ++i) {
    const auto job = http.Post("/jobs", endless_scene(), "application/json");
    ASSERT_EQ(job->status, 202);
    others.push_back(nlohmann::json::parse(job->body).at("id"));
  }
  Process client(turn(server, small_scene, 2, {"--samples", "1"}));
  EXPECT_TRUE(eventually([&] { return asked(server) >= 5; })) << asked(server);
  EXPECT_FALSE(client.wait(0ms)) << client.err();
  for (const std::string& id : others) http.Delete("/jobs/" + id);
  EXPECT_EQ(client.wait(30s), 0) << client.err();
}

}  // namespace
}  // namespace raytracer::test
