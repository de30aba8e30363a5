// A client that leaves: what it asked for is not rendered any further.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "tests/process/patience.h"
#include "tests/service/documents.h"
#include "tests/service/raw_connection.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

std::string render_request(const std::string& document) {
  return fmt::format(
      "POST /render HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
      "Content-Length: {}\r\n\r\n{}",
      document.size(), document);
}

TEST(Disconnect, render_ends_when_its_client_leaves) {
  // Nobody may wait here, so "ready" says that a place is free: that a render has ended.
  const ServerProcess server({"--threads", "1", "--max-queue", "0"});
  std::vector<std::unique_ptr<RawConnection>> clients;
  const auto is_full = [&] { return get(server, "/readyz").status == 503; };
  for (int i = 0; i < 4; ++i) {
    clients.push_back(std::make_unique<RawConnection>(server.port()));
    clients.back()->send(render_request(as_another_picture(endless_scene(), i)));
  }
  ASSERT_TRUE(eventually(is_full));
  clients.clear();
  EXPECT_TRUE(eventually([&] { return !is_full(); }, 5s)) << "nobody waits, but it still renders";
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(post(server, "/render", small_scene).status, 200);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, patience(3s));
}

TEST(Disconnect, waiting_render_leaves_the_queue_with_its_client) {
  const ServerProcess server({"--threads", "1", "--max-queue", "1"});
  for (int i = 0; i < 4; ++i) ASSERT_EQ(post(server, "/jobs", endless_scene()).status, 202);
  auto client = std::make_unique<RawConnection>(server.port());
  client->send(render_request(small_scene));
  const auto is_full = [&] { return get(server, "/readyz").status == 503; };
  ASSERT_TRUE(eventually(is_full));
  client.reset();
  EXPECT_TRUE(eventually([&] { return !is_full(); }, 5s))
      << "its place in the queue is still taken";
}

TEST(Disconnect, render_ends_whose_client_left_in_the_first_moment) {
  const ServerProcess server({"--threads", "1", "--max-queue", "20"});
  // Renders that are over before anybody looked at their clients.
  for (int i = 0; i < 200; ++i)
    ASSERT_EQ(post(server, "/render", as_another_picture(small_scene, i)).status, 200);
  for (int i = 0; i < 20; ++i) {
    RawConnection client(server.port());
    // The second request is never read, so that closing resets the connection.
    client.send(render_request(as_another_picture(endless_scene(), i)) + render_request("{}"));
  }
  EXPECT_TRUE(eventually(
      [&] {
        const std::string metrics = get(server, "/metrics").body;
        return metrics.find("\nraytracer_renders_running 0\n") != std::string::npos &&
               metrics.find("\nraytracer_queue_length 0\n") != std::string::npos;
      },
      5s))
      << get(server, "/metrics").body.substr(0, 2000);
}

TEST(Disconnect, client_that_leaves_before_its_answer_is_read_harms_nobody) {
  const ServerProcess server;
  for (int i = 0; i < 30; ++i) {
    RawConnection client(server.port());
    client.send(render_request(square_scene(200, 1)));
  }
  EXPECT_EQ(post(server, "/render", small_scene).status, 200);
}

}  // namespace
}  // namespace raytracer::test
