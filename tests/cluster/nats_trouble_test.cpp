// NATS that is there and does not do what it is asked for: it refuses, it hangs, it lacks
// something. Who runs the servers is told once, and what needs nobody else goes on.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <string>
#include <thread>

#include "tests/cluster/cluster_test.h"
#include "tests/service/documents.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

class NatsTrouble : public ClusterTest {
 protected:
  void restart(const Flags& flags) {
    nats().kill();
    nats().start(flags);
  }
};

Flags with_password(const std::string& password) {
  return {"--jetstream", "--user", "render", "--pass", password};
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST_F(NatsTrouble, password_that_is_wrong_for_a_while_ends_nothing) {
  restart(with_password("right1"));
  const Flags known{"--nats", nats().url_of("render", "right1")};
  const ServerProcess& front = start_front(known);
  const ServerProcess& worker = start_worker(known);
  ASSERT_TRUE(has_workers(front, 1));
  restart(with_password("other1"));
  for (const ServerProcess* const server : {&front, &worker})
    EXPECT_TRUE(comes_to_say(*server, "refuses these credentials")) << server->log();
  std::this_thread::sleep_for(2s);  // several tries
  EXPECT_EQ(readiness(front), "degraded");
  restart(with_password("right1"));
  for (const ServerProcess* const server : {&front, &worker}) {
    EXPECT_TRUE(becomes(*server, "ok"));
    EXPECT_TRUE(comes_to_say(*server, "is back")) << server->log();
    EXPECT_EQ(count(server->log(), "refuses these credentials"), 1U) << server->log();
    EXPECT_EQ(count(server->log(), " is lost,"), 1U) << server->log();
    EXPECT_EQ(count(server->log(), "note=\"NATS"), 3U) << server->log();
    EXPECT_EQ(server->log().find("right1"), std::string::npos) << server->log();
  }
  ASSERT_TRUE(has_workers(front, 1));
  EXPECT_TRUE(ends_done(front, post_job(front, "", small_scene))) << "nobody hears of tasks";
}

TEST_F(NatsTrouble, server_that_it_refuses_says_so_and_renders) {
  restart(with_password("right1"));
  const ServerProcess& stranger = start({"--nats", nats().url_of("render", "guess1")});
  EXPECT_TRUE(comes_to_say(stranger, "127.0.0.1"));
  EXPECT_NE(stranger.log().find("Authorization Violation"), std::string::npos) << stranger.log();
  EXPECT_NE(stranger.log().find("--nats and NATS_CREDS"), std::string::npos) << stranger.log();
  EXPECT_EQ(stranger.log().find("guess1"), std::string::npos) << stranger.log();
  std::string tls = nats().url();
  tls.replace(0, tls.find(':'), "tls");
  const ServerProcess& careful = start({"--nats", tls});
  EXPECT_TRUE(comes_to_say(careful, "NATS_CA")) << careful.log();
  for (const ServerProcess* const server : {&stranger, &careful}) {
    EXPECT_EQ(readiness(*server), "degraded");
    EXPECT_EQ(post(*server, "/render", small_scene).status, 200);
  }
}

TEST_F(NatsTrouble, nats_that_cannot_be_reached_is_said_once_and_so_is_its_return) {
  nats().kill();
  const ServerProcess& front = start_front();
  std::this_thread::sleep_for(1500ms);  // several tries
  EXPECT_EQ(count(front.log(), "cannot be reached"), 1U) << front.log();
  nats().start();
  EXPECT_TRUE(comes_to_say(front, "is back"));
  EXPECT_EQ(count(front.log(), "note="), 2U) << front.log();
}

TEST_F(NatsTrouble, one_of_several_urls_is_enough) {
  const ServerProcess& front = start_front({"--nats", "nats://127.0.0.1:1," + nats().url()});
  EXPECT_TRUE(becomes(front, "ok"));
  EXPECT_TRUE(eventually([&] { return get(front, "/cluster").status == 200; }));
}

TEST_F(NatsTrouble, nats_without_jetstream_is_degraded) {
  restart({});
  const ServerProcess& front = start_front();
  EXPECT_TRUE(becomes(front, "degraded"));
  EXPECT_EQ(metric_of(front, "raytracer_cluster_connected"), 0);
  EXPECT_TRUE(comes_to_say(front, "has no JetStream")) << front.log();
  expect_problem(post(front, "/jobs", small_scene), 503, "JetStream");
  std::this_thread::sleep_for(1500ms);  // several tries
  EXPECT_EQ(count(front.log(), "note="), 1U) << front.log();
  restart({"--jetstream"});
  EXPECT_TRUE(becomes(front, "ok"));
  EXPECT_EQ(metric_of(front, "raytracer_cluster_connected"), 1);
}

TEST_F(NatsTrouble, health_is_said_at_once_while_it_hangs) {
  const ServerProcess& front = start_front();
  ASSERT_TRUE(becomes(front, "ok"));
  nats().signal(SIGSTOP);
  const auto begin = std::chrono::steady_clock::now();
  auto longest = 0ns;
  // What is asked while libnats tries to connect counts, too.
  while (std::chrono::steady_clock::now() - begin < 13s) {
    for (const char* const path : {"/healthz", "/readyz", "/metrics"}) {
      const auto asked = std::chrono::steady_clock::now();
      EXPECT_EQ(get(front, path).status, 200);
      longest = std::max(longest, std::chrono::steady_clock::now() - asked);
    }
    std::this_thread::sleep_for(20ms);
  }
  EXPECT_LT(longest, patience(1s));
  EXPECT_EQ(readiness(front), "degraded");
  nats().signal(SIGCONT);
  EXPECT_TRUE(becomes(front, "ok"));
}

}  // namespace
}  // namespace raytracer::test
