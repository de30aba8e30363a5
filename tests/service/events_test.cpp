// GET /jobs/ID/events: what becomes of a job, told as it happens.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
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
using Connections = std::vector<std::unique_ptr<RawConnection>>;

constexpr std::size_t most_streams = 32;

std::string start(const ServerProcess& server, const std::string& document,
                  const std::string& query = "") {
  const Answer answer = post(server, "/jobs" + query, document);
  EXPECT_EQ(answer.status, 202) << answer.body;
  return answer.get_header_value("Location");
}

std::unique_ptr<RawConnection> watch(const ServerProcess& server, const std::string& job) {
  auto connection = std::make_unique<RawConnection>(server.port());
  connection->send(
      fmt::format("GET {}/events HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", job));
  return connection;
}

int count(std::string_view text, std::string_view part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

/// The data of the last event, as JSON.
nlohmann::json last_data(const std::string& stream) {
  const std::size_t begin = stream.rfind("data: ");
  if (begin == std::string::npos) return nullptr;
  return nlohmann::json::parse(stream.substr(begin + 6, stream.find('\n', begin) - begin - 6),
                               nullptr, false);
}

TEST(Events, tell_of_progress_while_the_job_runs_and_then_of_its_end) {
  const ServerProcess server;
  const std::string job = start(server, endless_scene(), "?budget_ms=3000");
  const auto begin = std::chrono::steady_clock::now();
  const auto stream = watch(server, job);
  EXPECT_TRUE(stream->receives("event: progress\ndata: {", 10s)) << stream->received();
  EXPECT_NE(stream->received().find("Content-Type: text/event-stream\r\n"), std::string::npos);
  ASSERT_TRUE(stream->ends(20s));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  const std::string& text = stream->received();
  EXPECT_NE(text.find(R"("status":"running")"), std::string::npos) << text;
  EXPECT_GT(count(text, "event: progress\n"), 2) << text;
  EXPECT_LE(count(text, "event: progress\n"), 2 + 10 * took.count()) << "more than ten a second:\n"
                                                                     << text;
  EXPECT_EQ(count(text, "event: done\n"), 1) << text;
  EXPECT_GT(text.find("event: done\n"), text.rfind("event: progress\n"));
  const nlohmann::json data = last_data(text);
  EXPECT_EQ("/jobs/" + data.value("id", ""), job);
  EXPECT_EQ(data.value("status", ""), "done");
  EXPECT_EQ(data.value("progress", 0.0), 1);
}

TEST(Events, of_a_job_that_has_ended_are_its_end) {
  const ServerProcess server;
  const std::string job = start(server, small_scene);
  ASSERT_TRUE(eventually([&] { return json_of(get(server, job)).value("status", "") == "done"; }));
  const Answer answer = get(server, job + "/events");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.get_header_value("Cache-Control"), "no-store");
  EXPECT_EQ(answer.body.rfind("event: done\ndata: {", 0), 0U) << answer.body;
  EXPECT_TRUE(answer.body.ends_with("\n\n")) << answer.body;
  EXPECT_EQ(count(answer.body, "event: "), 1) << answer.body;
}

TEST(Events, end_with_cancelled_when_the_job_is_deleted) {
  const ServerProcess server({"--threads", "1"});
  const std::string job = start(server, endless_scene());
  const auto stream = watch(server, job);
  ASSERT_TRUE(stream->receives("event: progress", 5s)) << stream->received();
  EXPECT_EQ(request(server, "DELETE", job).status, 204);
  EXPECT_TRUE(stream->ends(5s));
  EXPECT_EQ(count(stream->received(), "event: cancelled\n"), 1) << stream->received();
}

TEST(Events, have_comments_while_nothing_happens) {
  const ServerProcess server({"--threads", "1"});
  for (int i = 0; i < 4; ++i) start(server, endless_scene());
  const auto stream = watch(server, start(server, small_scene));
  ASSERT_TRUE(stream->receives(R"("status":"queued")", 5s)) << stream->received();
  EXPECT_TRUE(stream->receives("\n: ", 8s)) << stream->received();
  EXPECT_EQ(count(stream->received(), "event: "), 1) << stream->received();
}

TEST(Events, are_a_get_like_any_other) {
  const ServerProcess server({"--threads", "1"});
  const std::string events = start(server, endless_scene()) + "/events";
  const Answer head = request(server, "HEAD", events);
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.get_header_value("Content-Type"), "text/event-stream");
  const Answer posted = post(server, events, "{}");
  EXPECT_EQ(posted.status, 405);
  EXPECT_EQ(posted.get_header_value("Allow"), "GET, HEAD");
  expect_problem(get(server, "/jobs/1/events"), 404, "job");
}

TEST(Events, streams_are_so_many_and_no_more_and_a_client_that_leaves_makes_room) {
  // No renders may wait: so few HTTP threads are there that streams without their own would show.
  const ServerProcess server({"--threads", "1", "--max-queue", "0"});
  const std::string job = start(server, endless_scene());
  Connections streams;
  for (std::size_t i = 0; i < most_streams; ++i) {
    streams.push_back(watch(server, job));
    ASSERT_TRUE(streams.back()->receives("event: progress", 10s)) << i;
  }
  const Answer refused = get(server, job + "/events");
  expect_problem(refused, 429, "event streams");
  EXPECT_NE(refused.get_header_value("Retry-After"), "");
  EXPECT_EQ(get(server, job).status, 200);
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 20; ++i) EXPECT_EQ(get(server, "/healthz").status, 200);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, patience(2s));

  streams.pop_back();
  EXPECT_TRUE(eventually(
      [&] {
        streams.push_back(watch(server, job));
        return streams.back()->receives("event: progress", 500ms);
      },
      5s))
      << "the place of a client that left is still taken";
}

TEST(Events, do_not_keep_the_server_from_its_end) {
  ServerProcess server({"--threads", "1"});
  const std::string job = start(server, endless_scene());
  const auto reader = watch(server, job);
  const auto idle = watch(server, job);  // reads nothing
  ASSERT_TRUE(reader->receives("event: progress", 5s));
  server.signal(SIGTERM);
  ASSERT_TRUE(eventually([&] { return server.log().find("shutting down") != std::string::npos; }));
  server.signal(SIGTERM);
  EXPECT_TRUE(reader->ends(5s));
  EXPECT_EQ(count(reader->received(), "event: cancelled\n"), 1) << reader->received();
  EXPECT_EQ(server.wait(5s), 0) << server.log();
}

TEST(Events, of_what_is_finished_at_the_end_are_told) {
  ServerProcess server({"--threads", "1"});
  const std::string job = start(server, endless_scene(), "?budget_ms=1000");
  const auto stream = watch(server, job);
  ASSERT_TRUE(stream->receives("event: progress", 5s));
  server.signal(SIGTERM);
  EXPECT_TRUE(stream->ends(10s));
  EXPECT_EQ(count(stream->received(), "event: done\n"), 1) << stream->received();
  EXPECT_EQ(get(server, job + "/image").status, 200);
  EXPECT_EQ(server.wait(5s), 0) << server.log();
}

}  // namespace
}  // namespace raytracer::test
