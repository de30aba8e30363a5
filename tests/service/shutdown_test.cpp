// SIGTERM: no new work, what was accepted is answered, then the end with status 0.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include "tests/process/patience.h"
#include "tests/service/documents.h"
#include "tests/service/raw_connection.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

/// As many renders as run at once, begun; --max-queue 0 lets /readyz say that all of them are.
class Busy {
 public:
  Busy(const ServerProcess& server, const std::string& document, const std::string& query = "") {
    for (int i = 0; i < 4; ++i) {
      clients_.push_back(std::make_unique<RawConnection>(server.port()));
      const std::string own = as_another_picture(document, i);
      clients_.back()->send(
          fmt::format("POST /render{} HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
                      "Connection: close\r\nContent-Length: {}\r\n\r\n{}",
                      query, own.size(), own));
    }
    EXPECT_TRUE(eventually([&] { return get(server, "/readyz").status == 503; }));
  }
  void expect_answers(int status) {
    for (const auto& client : clients_) {
      EXPECT_TRUE(client->ends(20s));
      EXPECT_EQ(client->received().rfind(fmt::format("HTTP/1.1 {} ", status), 0), 0U)
          << client->received().substr(0, 300);
    }
  }

 private:
  std::vector<std::unique_ptr<RawConnection>> clients_;
};

/// 503, or nobody there any more.
bool refuses_new_work(const ServerProcess& server) {
  httplib::Client client = server.client();
  const auto answer = client.Post("/render", small_scene, "application/json");
  return !answer || answer->status == 503;
}

TEST(ShutdownSignal, idle_server_ends_at_once_with_status_0) {
  for (const int signal : {SIGTERM, SIGINT}) {
    ServerProcess server;
    server.signal(signal);
    EXPECT_EQ(server.wait(3s), 0) << server.log();
  }
}

TEST(ShutdownSignal, accepted_renders_are_finished_and_new_ones_refused) {
  ServerProcess server({"--max-queue", "0"});
  // By time, so that they are still running however fast the engine is.
  Busy renders(server, endless_scene(), "?budget_ms=2000");
  server.signal(SIGTERM);
  EXPECT_TRUE(eventually([&] { return refuses_new_work(server); }));
  renders.expect_answers(200);
  EXPECT_EQ(server.wait(), 0) << server.log();
}

TEST(ShutdownSignal, draining_server_says_so) {
  ServerProcess server({"--max-queue", "0"});
  Busy renders(server, endless_scene());
  server.signal(SIGTERM);
  ASSERT_TRUE(eventually([&] {
    const Answer answer = get(server, "/readyz");
    return answer.status == 503 && answer.body.find("draining") != std::string::npos;
  }));
  const Answer refused = post(server, "/render", small_scene);
  expect_problem(refused, 503, "shutting down");
  static const std::regex seconds("[1-9][0-9]*");
  EXPECT_TRUE(std::regex_match(refused.get_header_value("Retry-After"), seconds));
  EXPECT_EQ(get(server, "/healthz").status, 200);
  server.signal(SIGTERM);  // a second one: no more patience
  renders.expect_answers(503);
  EXPECT_EQ(server.wait(), 0) << server.log();
}

TEST(ShutdownSignal, work_is_taken_for_as_long_as_a_balancer_needs_to_notice) {
  ServerProcess server({"--drain-delay", "3000"});
  server.signal(SIGTERM);
  ASSERT_TRUE(eventually([&] { return get(server, "/readyz").status == 503; }));
  EXPECT_EQ(post(server, "/render", small_scene).status, 200);
  EXPECT_TRUE(eventually([&] { return refuses_new_work(server); }));
  EXPECT_EQ(server.wait(), 0) << server.log();
}

TEST(ShutdownSignal, second_signal_ends_the_delay) {
  ServerProcess server({"--drain-delay", "60000"});
  server.signal(SIGTERM);
  ASSERT_TRUE(eventually([&] { return get(server, "/readyz").status == 503; }));
  server.signal(SIGTERM);
  EXPECT_EQ(server.wait(), 0) << server.log();
}

TEST(ShutdownSignal, open_connections_do_not_delay_the_end) {
  ServerProcess server;
  RawConnection silent(server.port());
  RawConnection half(server.port());
  half.send("POST /render HTTP/1.1\r\nHost: x\r\nContent-Le");
  httplib::Client idle = server.client();
  idle.set_keep_alive(true);
  ASSERT_TRUE(idle.Get("/healthz"));
  server.signal(SIGTERM);
  EXPECT_EQ(server.wait(5s), 0) << server.log();
}

/// A job that is done within the second, on its way when it is returned.
std::string start_short_job(const ServerProcess& server) {
  std::string job =
      post(server, "/jobs?budget_ms=500", endless_scene()).get_header_value("Location");
  EXPECT_TRUE(
      eventually([&] { return json_of(get(server, job)).value("status", "") == "running"; }));
  return job;
}

TEST(ShutdownSignal, finished_job_is_kept_until_it_is_fetched) {
  ServerProcess server;
  const std::string job = start_short_job(server);
  server.signal(SIGTERM);
  ASSERT_TRUE(eventually([&] { return json_of(get(server, job)).value("status", "") == "done"; }));
  std::this_thread::sleep_for(1s);  // a page may take its time
  EXPECT_EQ(request(server, "HEAD", job + "/image").status, 200) << "which fetches nothing";
  const Answer image = get(server, job + "/image");
  EXPECT_EQ(image.status, 200);
  EXPECT_EQ(image.get_header_value("Render-Stop"), "budget");
  EXPECT_EQ(server.wait(2s), 0) << server.log();
}

TEST(ShutdownSignal, job_that_nobody_fetches_does_not_keep_the_server_for_ever) {
  ServerProcess server;
  start_short_job(server);
  server.signal(SIGTERM);
  std::this_thread::sleep_for(3s);
  EXPECT_FALSE(server.wait(0s)) << "nobody had the time to fetch it";
  EXPECT_EQ(server.wait(8s), 0) << server.log();
}

TEST(ShutdownSignal, job_that_was_fetched_or_deleted_keeps_nobody) {
  ServerProcess server;
  const std::string fetched = start_short_job(server);
  const std::string deleted = start_short_job(server);
  for (const std::string& job : {fetched, deleted})
    ASSERT_TRUE(
        eventually([&] { return json_of(get(server, job)).value("status", "") == "done"; }));
  EXPECT_EQ(get(server, fetched + "/image").status, 200);
  EXPECT_EQ(request(server, "DELETE", deleted).status, 204);
  server.signal(SIGTERM);
  EXPECT_EQ(server.wait(3s), 0) << server.log();
}

TEST(ShutdownSignal, running_job_does_not_keep_the_server_for_ever) {
  ServerProcess server;
  ASSERT_EQ(post(server, "/jobs", endless_scene()).status, 202);
  server.signal(SIGTERM);
  ASSERT_TRUE(eventually([&] { return server.log().find("shutting down") != std::string::npos; }));
  server.signal(SIGTERM);
  EXPECT_EQ(server.wait(5s), 0) << server.log();
}

}  // namespace
}  // namespace raytracer::test
