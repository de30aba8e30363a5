// --server and RAYTRACER_SERVER: another's daemon, and what happens when it is not there.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/cli/client.h"
#include "tests/process/patience.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

/// An address where nobody listens: of a daemon that has ended.
std::string dead_url() {
  ServerProcess server;
  server.signal(SIGTERM);
  EXPECT_EQ(server.wait(), 0);
  return server.url();
}

class ServerChoice : public Client {};

TEST_F(ServerChoice, flag_and_variable_name_the_daemon) {
  // Seen in the daemon's log, so that it is this one and not a private one.
  const ServerProcess other;
  EXPECT_EQ(run_client({"scenes", "--server", other.url()}).status, 0);
  EXPECT_TRUE(eventually([&] { return other.log().find("GET /scenes") != std::string::npos; }));
  EXPECT_EQ(run_client({"validate", "-"}, small_scene, {{"RAYTRACER_SERVER", other.url()}}).status,
            0);
  EXPECT_TRUE(eventually([&] { return other.log().find("POST /render") != std::string::npos; }))
      << other.log();
}

TEST_F(ServerChoice, flag_stands_over_the_variable) {
  const Outcome outcome =
      run_client({"scenes", "--server", server().url()}, "", {{"RAYTRACER_SERVER", dead_url()}});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST_F(ServerChoice, unreachable_daemon_is_status_2_with_its_address) {
  const std::string url = dead_url();
  for (const char* const command : {"render", "validate"}) {
    const Outcome outcome = run_client({command, "-", "--server", url}, small_scene);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(url), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(run_client({"scenes"}, "", {{"RAYTRACER_SERVER", url}}).status, 2);
}

TEST_F(ServerChoice, token_is_sent_and_its_lack_explained) {
  const ServerProcess locked({"--token", "s3cret"});
  const Outcome without = run_client({"scenes", "--server", locked.url()});
  expect_input_error(without, "--token");
  EXPECT_EQ(run_client({"scenes", "--server", locked.url(), "--token", "s3cret"}).status, 0);
  EXPECT_EQ(run_client({"render", "-"}, small_scene,
                       {{"RAYTRACER_SERVER", locked.url()}, {"RAYTRACER_TOKEN", "s3cret"}})
                .status,
            0);
}

TEST_F(ServerChoice, full_daemon_is_status_2_with_the_time_to_wait) {
  const ServerProcess full({"--threads", "1", "--max-queue", "0"});
  httplib::Client http = full.client();
  for (int i = 0; i < 4; ++i)
    ASSERT_EQ(http.Post("/jobs", endless_scene(), "application/json")->status, 202);
  const Outcome outcome = run_client({"render", "-", "--server", full.url()}, small_scene);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("try again in"), std::string::npos) << outcome.err;
}

TEST_F(ServerChoice, daemon_that_dies_meanwhile_is_status_2) {
  auto server = std::make_unique<ServerProcess>();
  Process client(client_command({"render", "-", "--server", server->url()}, endless_scene()));
  ASSERT_TRUE(eventually([&] { return server->log().find("GET /jobs/") != std::string::npos; }));
  server.reset();
  EXPECT_EQ(client.wait(15s), 2) << client.err();
  EXPECT_NE(client.err(), "");
}

TEST_F(ServerChoice, something_else_that_answers_is_status_2) {
  httplib::Server impostor;
  impostor.Get(".*", [](const httplib::Request&, httplib::Response& response) {
    response.set_content("<html>hello</html>", "text/html");
  });
  impostor.Post(".*", [](const httplib::Request&, httplib::Response& response) {
    response.set_content("<html>hello</html>", "text/html");
  });
  const int port = impostor.bind_to_any_port("127.0.0.1");
  std::thread thread([&] { impostor.listen_after_bind(); });
  const std::string url = "http://127.0.0.1:" + std::to_string(port);
  for (const auto& arguments :
       {std::vector<std::string>{"scenes"}, {"render", "-"}, {"validate", "-"}}) {
    const Outcome outcome = run_client(arguments, small_scene, {{"RAYTRACER_SERVER", url}});
    EXPECT_EQ(outcome.status, 2) << testing::PrintToString(arguments) << outcome.out << outcome.err;
    EXPECT_NE(outcome.err.find(url), std::string::npos) << outcome.err;
  }
  impostor.stop();
  thread.join();
}

}  // namespace
}  // namespace raytracer::test
