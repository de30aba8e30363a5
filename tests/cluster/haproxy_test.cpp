// What server/deploy/haproxy.cfg promises: equal scenes at one front, nobody notices a front that
// dies or is drained. The fronts are plain servers: none of this needs NATS.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <csignal>
#include <functional>
#include <iostream>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "tests/cluster/balancer.h"
#include "tests/cluster/traffic.h"
#include "tests/process/endless_scene.h"
#include "tests/process/patience.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

const std::string scene = R"({
  "camera": {"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 0.9, "width": 96, "height": 72},
  "lights": [{"type": "distant", "direction": [-1, -1, 2]}],
  "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1}]
})";
const std::vector<std::string> shipped{"demo",    "first-sphere", "mirrors", "oranges",
                                       "pillars", "spheres",      "glints",  "point-light"};

/// Three servers of one thread behind HAProxy.
class Haproxy : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_balancer()) GTEST_SKIP() << "haproxy is not installed: .ci/install cluster";
    for (int i = 0; i < 3; ++i) fronts_.push_back(std::make_unique<ServerProcess>(front_flags));
    balancer_ = std::make_unique<Balancer>(fronts_);
    // The request that found that it answers counts as a front's load until it has been closed.
    std::this_thread::sleep_for(100ms);
  }

  httplib::Client client() const { return balancer_->client(); }
  ServerProcess& front(std::size_t index) { return *fronts_.at(index); }
  std::string log() const { return balancer_->log(); }

  /// The fronts that answer eight requests. They are asked again only if HAProxy has said that it
  /// took one for dead meanwhile, as where a busy machine keeps it from answering a check.
  std::set<std::string> fronts_of(const std::function<httplib::Result(int)>& ask) const;

  static inline const std::vector<std::string> front_flags{
      "--threads", "1", "--quiet", "--drain-delay", "1500", "--max-queue", "16"};

 private:
  std::vector<std::unique_ptr<ServerProcess>> fronts_;
  std::unique_ptr<Balancer> balancer_;
};

/// Which front answered: each begins its ids in a way of its own.
std::string front_of(const httplib::Result& answer) {
  EXPECT_TRUE(answer) << httplib::to_string(answer.error());
  if (!answer) return "none";
  EXPECT_EQ(answer->status, 200) << answer->body;
  const std::string id = answer->get_header_value("X-Request-Id");
  return id.substr(0, id.find('-'));
}

httplib::Result get_small_render(httplib::Client& client, int number) {
  return client.Get(fmt::format("/render?scene={}&width=96&height=72&samples={}",
                                shipped[static_cast<std::size_t>(number) % shipped.size()],
                                1 + number % 7));
}

httplib::Result post_small_render(httplib::Client& client, int number) {
  return client.Post(fmt::format("/render?samples={}", 1 + number % 7), scene, "application/json");
}

TEST_F(Haproxy, no_get_fails_while_a_front_is_killed_and_another_is_drained) {
  Traffic traffic(
      16, [this] { return client(); }, get_small_render);
  EXPECT_TRUE(traffic.go_on(2000));
  front(0).signal(SIGKILL);
  EXPECT_TRUE(traffic.go_on(2000));
  front(1).signal(SIGTERM);
  EXPECT_EQ(front(1).wait(), 0) << front(1).log();
  EXPECT_TRUE(traffic.go_on(2000));
  EXPECT_EQ(traffic.end(), "") << log();
  std::cout << traffic.answered() << " requests\n";
}

/// Not when one is killed: what it may have begun is not repeated.
TEST_F(Haproxy, no_post_fails_while_two_fronts_are_drained) {
  Traffic traffic(
      16, [this] { return client(); }, post_small_render);
  EXPECT_TRUE(traffic.go_on(1000));
  for (const std::size_t index : {0, 1}) {
    front(index).signal(SIGTERM);
    EXPECT_EQ(front(index).wait(), 0) << front(index).log();
    EXPECT_TRUE(traffic.go_on(1000));
  }
  EXPECT_EQ(traffic.end(), "") << log();
  std::cout << traffic.answered() << " requests\n";
}

TEST_F(Haproxy, post_that_a_front_has_begun_is_not_repeated) {
  std::optional<httplib::Result> answer;
  std::thread asking([&] {
    answer.emplace(client().Post("/render?scene=demo&width=1920&height=1080&budget_ms=20000"));
  });
  const auto is_running = [&](std::size_t index) {
    const httplib::Result metrics = front(index).client().Get("/metrics");
    return metrics && metrics->body.find("\nraytracer_renders_running 1") != std::string::npos;
  };
  std::size_t busy = 3;
  EXPECT_TRUE(eventually([&] {
    for (busy = 0; busy < 3 && !is_running(busy);) ++busy;
    return busy < 3;
  }));
  if (busy < 3) front(busy).signal(SIGKILL);
  asking.join();
  EXPECT_TRUE(!*answer || (*answer)->status == 502);
  for (std::size_t index = 0; index < 3; ++index)
    EXPECT_TRUE(index == busy || !is_running(index)) << index;
}

std::set<std::string> Haproxy::fronts_of(const std::function<httplib::Result(int)>& ask) const {
  std::set<std::string> fronts;
  for (int attempt = 0; attempt < 5; ++attempt) {
    const std::size_t said = log().size();
    fronts.clear();
    for (int i = 1; i <= 8; ++i) fronts.insert(front_of(ask(i)));
    const std::string more = log().substr(said);
    if (more.find(" is DOWN") == more.npos && more.find(" is UP") == more.npos) break;
  }
  return fronts;
}

TEST_F(Haproxy, equal_scenes_go_to_one_front_by_query_or_header) {
  httplib::Client http = client();
  std::set<std::string> by_query;
  std::set<std::string> by_header;
  for (const std::string& name : shipped) {
    const std::set<std::string> of_query = fronts_of([&](int samples) {
      return http.Get(fmt::format("/render?width=8&height=6&scene={}&samples={}", name, samples));
    });
    EXPECT_EQ(of_query.size(), 1U) << name;
    by_query.insert(of_query.begin(), of_query.end());
    const std::set<std::string> of_header = fronts_of([&](int samples) {
      return http.Post(fmt::format("/render?samples={}", samples), {{"Scene-Digest", name}}, scene,
                       "application/json");
    });
    EXPECT_EQ(of_header.size(), 1U) << name;
    by_header.insert(of_header.begin(), of_header.end());
  }
  EXPECT_GT(by_query.size(), 1U);
  EXPECT_EQ(by_query, by_header) << "the same name is the same scene";
}

TEST_F(Haproxy, requests_that_name_no_scene_are_spread) {
  httplib::Client http = client();
  std::map<std::string, int> counts;
  for (int i = 0; i < 90; ++i) ++counts[front_of(post_small_render(http, i))];
  EXPECT_EQ(counts.size(), 3U);
  for (const auto& [front, count] : counts) EXPECT_GE(count, 5) << front;
}

TEST_F(Haproxy, scene_that_everybody_wants_is_shared_among_fronts) {
  std::mutex mutex;
  std::set<std::string> fronts;
  std::vector<std::thread> clients;
  clients.reserve(12);
  for (int i = 0; i < 12; ++i)
    clients.emplace_back([&, i] {
      httplib::Client http = client();
      // By time, so that all are under way together; each another picture.
      const std::string target = fmt::format("/render?scene=demo&width={}&budget_ms=1500", 640 + i);
      const std::string front = front_of(http.Get(target));
      const std::scoped_lock lock(mutex);
      fronts.insert(front);
    });
  for (std::thread& thread : clients) thread.join();
  EXPECT_EQ(fronts.size(), 3U);
}

TEST_F(Haproxy, full_fronts_still_say_so_themselves) {
  httplib::Client http = client();
  const auto post_job = [&] { return http.Post("/jobs", endless_scene(), "application/json"); };
  int accepted = 0;  // each front runs four, and 16 wait there
  ASSERT_TRUE(eventually([&] {
    const httplib::Result job = post_job();
    accepted += job && job->status == 202;
    return accepted == 60;
  })) << accepted;
  std::this_thread::sleep_for(1s);  // until HAProxy has noticed that none is ready
  const httplib::Result refused = post_job();
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->status, 429) << refused->body;
  EXPECT_TRUE(refused->has_header("Retry-After"));
  const httplib::Result health = http.Get("/healthz");
  ASSERT_TRUE(health);
  EXPECT_EQ(health->status, 200);
}

TEST_F(Haproxy, without_a_front_its_own_answer_is_a_problem_too) {
  for (std::size_t index : {0, 1, 2}) {
    front(index).signal(SIGKILL);
    front(index).wait();  // while it dies it may still take a connection, for which 502 is right
  }
  httplib::Client http = client();
  const httplib::Result answer = http.Get("/render?scene=demo");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 503);
  EXPECT_EQ(answer->get_header_value("Content-Type"), "application/problem+json");
  EXPECT_TRUE(answer->has_header("Retry-After"));
  EXPECT_NE(answer->body.find("\"detail\""), std::string::npos) << answer->body;
}

}  // namespace
}  // namespace raytracer::test
