// Equal requests at the same time: rendered once, for all who wait.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/process/patience.h"
#include "tests/service/documents.h"
#include "tests/service/raw_connection.h"
#include "tests/service/server_timing.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

/// A server whose every running place is taken by a job, so that renders wait until release().
/// "Ready" says whether the queue, of one place unless said otherwise, has room.
class SharedRender : public testing::Test {
 protected:
  explicit SharedRender(const std::string& places = "1")
      : server_({"--threads", "2", "--max-queue", places}) {
    for (int i = 0; i < 4; ++i)
      jobs_.push_back(post(server_, "/jobs", endless_scene()).get_header_value("Location"));
  }

  std::unique_ptr<RawConnection> begin_render(const std::string& fields = "") const {
    auto client = std::make_unique<RawConnection>(server_.port());
    client->send(
        fmt::format("POST /render HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
                    "Connection: close\r\n{}Content-Length: {}\r\n\r\n{}",
                    fields, small_scene.size(), small_scene));
    return client;
  }
  /// Two clients, the first of which is the first to have asked.
  std::vector<std::unique_ptr<RawConnection>> begin_two() const {
    std::vector<std::unique_ptr<RawConnection>> clients;
    clients.push_back(begin_render());
    EXPECT_TRUE(eventually([&] { return !is_ready(); }));
    clients.push_back(begin_render());
    std::this_thread::sleep_for(patience(200ms));  // nothing shows that it waits
    return clients;
  }
  bool is_ready() const { return get(server_, "/readyz").status == 200; }
  void release() {
    for (const std::string& job : jobs_) request(server_, "DELETE", job);
  }
  const ServerProcess& server() const { return server_; }

  /// The answer when it has come whole.
  static std::string received(RawConnection& client) {
    EXPECT_TRUE(client.ends(20s));
    return client.received();
  }
  static bool is_ok(const std::string& answer) { return answer.starts_with("HTTP/1.1 200 "); }
  static std::string body_of(const std::string& answer) {
    return answer.substr(answer.find("\r\n\r\n") + 4);
  }

 private:
  const ServerProcess server_;
  std::vector<std::string> jobs_;
};

class SharedRenderBeforeTwoPlaces : public SharedRender {
 protected:
  SharedRenderBeforeTwoPlaces() : SharedRender("2") {}
};

TEST_F(SharedRender, second_request_waits_for_the_firsts_result) {
  const auto clients = begin_two();
  release();
  const std::string first = received(*clients[0]);
  const std::string second = received(*clients[1]);
  ASSERT_TRUE(is_ok(first)) << first;
  ASSERT_TRUE(is_ok(second)) << second;
  EXPECT_EQ(cache_entry(first), "");
  EXPECT_EQ(cache_entry(second), "shared");
  EXPECT_NE(second.find("trace;dur=0.000"), std::string::npos)
      << "its own time is none: " << second;
  EXPECT_EQ(body_of(first), body_of(second));
}

TEST_F(SharedRender, render_goes_on_for_others_when_the_first_client_leaves) {
  auto clients = begin_two();
  clients[0].reset();
  std::this_thread::sleep_for(patience(300ms));  // time for its leaving to be seen
  release();
  const std::string second = received(*clients[1]);
  ASSERT_TRUE(is_ok(second)) << second;
  EXPECT_EQ(cache_entry(second), "shared");
}

TEST_F(SharedRender, render_ends_when_all_have_left) {
  auto clients = begin_two();
  clients.clear();
  // The render's place in the queue is free again.
  const auto accepted = [&] { return post(server(), "/jobs", small_scene).status == 202; };
  EXPECT_TRUE(eventually(accepted, 5s));
}

TEST_F(SharedRender, next_client_is_served_after_all_have_left) {
  auto clients = begin_two();
  clients.clear();
  EXPECT_TRUE(eventually([&] { return is_ready(); }, 5s));
  const auto client = begin_render();
  release();
  const std::string answer = received(*client);
  EXPECT_TRUE(is_ok(answer)) << answer;
}

TEST_F(SharedRender, who_waits_for_anothers_render_takes_no_place_in_the_queue) {
  auto clients = begin_two();
  while (clients.size() < 8) clients.push_back(begin_render());
  const Answer other = post(server(), "/render", as_another_picture(small_scene, 1));
  expect_problem(other, 429, "--max-queue");
  EXPECT_TRUE(other.has_header("Retry-After"));
  release();
  for (const auto& client : clients) EXPECT_TRUE(is_ok(received(*client))) << client->received();
}

TEST(SharedRenderWithoutQueue, equal_request_is_not_refused) {
  const ServerProcess server({"--threads", "1", "--max-queue", "0"});
  const std::string document = endless_scene();
  const auto begin = [&](RawConnection& client) {
    client.send(
        fmt::format("POST /render HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
                    "Content-Length: {}\r\n\r\n{}",
                    document.size(), document));
  };
  for (int i = 0; i < 3; ++i) post(server, "/jobs", endless_scene());
  RawConnection first(server.port());
  begin(first);
  ASSERT_TRUE(eventually([&] { return get(server, "/readyz").status == 503; }));
  RawConnection second(server.port());
  begin(second);
  EXPECT_FALSE(second.receives("HTTP/1.1 ", 500ms)) << second.received();
}

TEST_F(SharedRenderBeforeTwoPlaces, insisting_client_gets_a_render_of_its_own) {
  const auto first = begin_render();
  const auto second = begin_render("Cache-Control: no-cache\r\n");
  EXPECT_TRUE(eventually([&] { return !is_ready(); }));
  release();
  for (RawConnection* const client : {first.get(), second.get()}) {
    const std::string answer = received(*client);
    EXPECT_TRUE(is_ok(answer)) << answer;
    EXPECT_EQ(cache_entry(answer), "");
  }
}

TEST_F(SharedRender, all_are_refused_when_the_server_ends) {
  const auto clients = begin_two();
  server().signal(SIGTERM);
  for (const auto& client : clients) {
    const std::string answer = received(*client);
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 503 ")) << answer;
  }
  release();
}

}  // namespace
}  // namespace raytracer::test
