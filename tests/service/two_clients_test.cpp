// Several clients at once: each gets its own answer, and none waits for another's long one.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "tests/process/patience.h"
#include "tests/service/documents.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

class TwoClients : public Service {};

TEST_F(TwoClients, each_gets_its_own_picture) {
  std::vector<std::string> expected;
  expected.reserve(8);
  for (int i = 0; i < 8; ++i) expected.push_back(post("/render", square_scene(60 + i, 2)).body);
  std::atomic<int> right{0};
  std::vector<std::thread> clients;
  clients.reserve(8);
  for (int i = 0; i < 8; ++i)
    clients.emplace_back([&, i] {
      for (int round = 0; round < 3; ++round) {
        const Answer answer = test::post(server(), "/render", square_scene(60 + i, 2));
        right += answer.status == 200 && answer.body == expected[static_cast<std::size_t>(i)];
      }
    });
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(right, 24);
}

TEST_F(TwoClients, short_render_passes_a_long_one) {
  const std::string job = post("/jobs", endless_scene()).get_header_value("Location");
  ASSERT_TRUE(eventually([&] { return json_of(get(job)).value("status", "") == "running"; }));
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(post("/render", small_scene).status, 200);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, patience(5s));
  EXPECT_EQ(json_of(get(job)).value("status", ""), "running");
  request("DELETE", job);
}

TEST_F(TwoClients, wrong_request_changes_no_other_answer) {
  const std::string expected = post("/render", square_scene(150, 4)).body;
  std::atomic<bool> done{false};
  std::thread troublemaker([&] {
    while (!done) {
      post("/render", std::string(1000, '['));
      post("/render?width=0", small_scene);
      get("/nothing");
    }
  });
  for (int i = 0; i < 5; ++i) EXPECT_EQ(post("/render", square_scene(150, 4)).body, expected);
  done = true;
  troublemaker.join();
}

TEST_F(TwoClients, burst_of_clients_is_answered) {
  std::atomic<int> answered{0};
  std::vector<std::thread> clients;
  clients.reserve(60);
  for (int i = 0; i < 60; ++i)
    clients.emplace_back([&] { answered += get("/healthz").status == 200; });
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(answered, 60);
}

}  // namespace
}  // namespace raytracer::test
