// Bodies that are refused before they are read, and what becomes of their connection.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
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

class Body : public Service {
 protected:
  /// Everything that the server answers until it closes. The body follows when the header was
  /// answered: httplib forgets what it read together with a header, so only bytes that come later
  /// can be taken for another request.
  static std::string raw(const std::string& header, const std::string& body) {
    RawConnection connection(server().port());
    connection.send(header);
    connection.receives("\n}\n", 5s);
    connection.send(body);
    EXPECT_TRUE(connection.ends(15s)) << "the connection stays open";
    return connection.received();
  }
  static void expect_only(const std::string& answers, int status) {
    EXPECT_EQ(answers.rfind(fmt::format("HTTP/1.1 {} ", status), 0), 0U) << answers;
    EXPECT_EQ(count_answers(answers), 1) << "what follows was taken for a request:\n" << answers;
    EXPECT_NE(answers.find("application/problem+json"), std::string::npos) << answers;
  }
};

/// A request that must never be answered, because it stands inside another's body.
const std::string smuggled = "GET /version HTTP/1.1\r\nHost: x\r\n\r\n";

TEST_F(Body, chunked_body_is_411_and_not_parsed_as_a_request) {
  expect_only(raw("POST /render HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
                  "Transfer-Encoding: chunked\r\n\r\n",
                  smuggled),
              411);
}

TEST_F(Body, chunked_body_beside_a_length_is_refused) {
  expect_only(raw("POST /render HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
                  "Content-Length: 4\r\nTransfer-Encoding: chunked\r\n\r\n",
                  "0\r\n\r\n" + smuggled),
              411);
}

TEST_F(Body, compressed_body_is_415_and_not_parsed_as_a_request) {
  for (const char* const coding : {"gzip", "br", "deflate", "identity, gzip"})
    expect_only(raw(fmt::format("POST /render HTTP/1.1\r\nHost: x\r\nContent-Length: {}\r\n"
                                "Content-Type: application/json\r\nContent-Encoding: {}\r\n\r\n",
                                smuggled.size(), coding),
                    smuggled),
                415);
}

TEST_F(Body, body_without_a_length_is_411_and_not_parsed_as_a_request) {
  for (const char* const length : {"", "Content-Length: \r\n"})
    expect_only(raw(fmt::format("POST /render HTTP/1.1\r\nHost: x\r\n"
                                "Content-Type: application/json\r\n{}\r\n",
                                length),
                    smuggled),
                411);
}

TEST_F(Body, lengths_that_are_no_number_are_refused) {
  for (const char* const length : {"-1", "1e3", "0x10", "4, 5", "+4"})
    expect_only(raw(fmt::format("POST /render HTTP/1.1\r\nHost: x\r\n"
                                "Content-Type: application/json\r\nContent-Length: {}\r\n\r\n",
                                length),
                    smuggled),
                400);
}

TEST_F(Body, two_lengths_are_refused) {
  expect_only(raw("POST /render HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
                  "Content-Length: 0\r\nContent-Length: 36\r\n\r\n",
                  smuggled),
              400);
}

TEST_F(Body, length_that_only_some_would_see_is_400_and_not_parsed_as_a_request) {
  for (const char* const name : {"Content-Length ", "Content-Length\t", "Transfer-Encoding "})
    expect_only(raw(fmt::format("POST /render HTTP/1.1\r\nHost: x\r\n"
                                "Content-Type: application/json\r\n{}: 36\r\n\r\n",
                                name),
                    smuggled),
                400);
}

TEST_F(Body, other_types_are_415_with_the_right_one) {
  for (const char* const type :
       {"text/plain", "application/x-www-form-urlencoded", "multipart/form-data; boundary=x"}) {
    const Answer answer = post("/render", small_scene, {{"Content-Type", type}});
    expect_problem(answer, 415, "application/json");
  }
  expect_only(raw("POST /render HTTP/1.1\r\nHost: x\r\nContent-Length: 2\r\n\r\n", "{}"), 415);
}

TEST_F(Body, json_with_parameters_is_json) {
  const Answer answer =
      post("/render", small_scene, {{"Content-Type", "Application/JSON; charset=utf-8"}});
  EXPECT_EQ(answer.status, 200) << answer.body;
}

TEST_F(Body, get_with_a_body_is_refused) {
  expect_only(raw(fmt::format("GET /healthz HTTP/1.1\r\nHost: x\r\nContent-Length: {}\r\n\r\n",
                              smuggled.size()),
                  smuggled),
              400);
}

TEST_F(Body, scene_named_and_posted_at_once_is_refused) {
  expect_problem(post("/render?scene=demo", small_scene), 400, "one of them");
}

TEST_F(Body, oversize_is_413_before_it_is_sent) {
  const ServerProcess small({"--max-body", "1000"});
  RawConnection connection(small.port());
  connection.send(
      "POST /render HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
      "Content-Length: 1001\r\n\r\n");
  ASSERT_TRUE(connection.ends(15s)) << "the server waits for a body that it will not take";
  expect_only(connection.received(), 413);
  EXPECT_NE(connection.received().find("--max-body"), std::string::npos);
}

TEST_F(Body, oversize_is_413_although_it_is_sent) {
  const ServerProcess small({"--max-body", "1000"});
  // More than the kernel's buffers hold, so that the server has to let it come in.
  const Answer answer = test::post(small, "/render", std::string(8'000'000, ' '));
  expect_problem(answer, 413, "--max-body");
}

TEST_F(Body, body_of_exactly_the_limit_is_taken) {
  std::string padded = small_scene;
  padded.resize(1000, ' ');
  const ServerProcess small({"--max-body", "1000"});
  EXPECT_EQ(test::post(small, "/render", padded).status, 200);
  EXPECT_EQ(test::post(small, "/render", padded + " ").status, 413);
}

TEST_F(Body, expectation_is_met_before_the_body_is_sent) {
  RawConnection connection(server().port());
  connection.send(
      fmt::format("POST /render HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
                  "Connection: close\r\nContent-Length: {}\r\nExpect: 100-continue\r\n\r\n",
                  small_scene.size()));
  ASSERT_TRUE(connection.receives("HTTP/1.1 100 Continue\r\n\r\n", 5s)) << connection.received();
  connection.send(small_scene);
  ASSERT_TRUE(connection.ends(15s));
  EXPECT_NE(connection.received().find("HTTP/1.1 200 OK"), std::string::npos);
}

TEST_F(Body, expectation_of_what_will_be_refused_is_refused) {
  const ServerProcess small({"--max-body", "1000"});
  RawConnection connection(small.port());
  connection.send(
      "POST /render HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
      "Content-Length: 1001\r\nExpect: 100-continue\r\n\r\n");
  ASSERT_TRUE(connection.ends(15s));
  EXPECT_EQ(connection.received().find("100 Continue"), std::string::npos);
  EXPECT_EQ(connection.received().rfind("HTTP/1.1 413 ", 0), 0U) << connection.received();
}

TEST_F(Body, connection_goes_on_after_an_error_in_a_body_that_was_read) {
  httplib::Client client = server().client();
  client.set_keep_alive(true);
  for (int i = 0; i < 3; ++i) {
    const auto wrong = client.Post("/render", "{\"camera\": 1}", "application/json");
    ASSERT_TRUE(wrong);
    EXPECT_EQ(wrong->status, 422);
    EXPECT_NE(wrong->get_header_value("Connection"), "close");
    const auto right = client.Post("/render", small_scene, "application/json");
    ASSERT_TRUE(right);
    EXPECT_EQ(right->status, 200);
  }
}

TEST_F(Body, body_that_stops_half_way_is_given_up) {
  RawConnection connection(server().port());
  connection.send(
      "POST /render HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
      "Content-Length: 500\r\n\r\n{\"camera\"");
  EXPECT_TRUE(connection.ends(20s)) << "the server still waits";
  EXPECT_EQ(get("/healthz").status, 200);
}

TEST_F(Body, body_that_trickles_is_given_up) {
  RawConnection connection(server().port());
  connection.send(
      "POST /render HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
      "Content-Length: 500\r\n\r\n");
  // Never silent for long enough to be cut off for that.
  const bool was_cut_off = eventually(
      [&] { return !connection.send(" ") || connection.receives("HTTP/1.1 408 ", 500ms); }, 40s);
  EXPECT_TRUE(was_cut_off) << "the server still waits";
  EXPECT_NE(connection.received().find("HTTP/1.1 408 "), std::string::npos);
}

std::string header_of_length(std::size_t length) {
  return fmt::format(
      "POST /render HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
      "Content-Length: {}\r\n\r\n",
      length);
}

TEST_F(Body, bodies_together_are_bounded) {
  // Two of the largest fit, which is all of the memory for them until their jobs have ended.
  constexpr std::size_t largest = 34'000'000;
  const ServerProcess small({"--max-body", std::to_string(largest), "--threads", "1"});
  std::string whole = endless_scene();
  whole.resize(largest - 1000, ' ');
  std::vector<std::string> jobs;
  for (int i = 0; i < 2; ++i)
    jobs.push_back(test::post(small, "/jobs", whole).get_header_value("Location"));
  std::string third = small_scene;
  third.resize(20'000, ' ');
  const Answer refused = test::post(small, "/render", third);
  expect_problem(refused, 429, "memory");
  EXPECT_TRUE(refused.has_header("Retry-After"));
  EXPECT_EQ(test::post(small, "/render", small_scene).status, 200) << "so much is left";
  for (const std::string& job : jobs) test::request(small, "DELETE", job);
  EXPECT_TRUE(eventually([&] { return test::post(small, "/render", third).status == 200; }));
}

TEST_F(Body, what_is_only_announced_costs_others_nothing) {
  RawConnection first(server().port());
  RawConnection second(server().port());
  for (RawConnection* const client : {&first, &second}) {
    client->send(header_of_length(134'217'728));
    client->send("{");
  }
  std::this_thread::sleep_for(patience(200ms));  // time to find out how long they shall be
  for (int i = 0; i < 3; ++i) EXPECT_EQ(post("/render", small_scene).status, 200);
}

TEST_F(Body, many_small_ones_fit_however_small_the_largest) {
  const ServerProcess small({"--max-body", "700", "--threads", "1"});
  std::string scene = square_scene(1000, 3000);  // which takes long
  scene.resize(700, ' ');
  for (int i = 0; i < 8; ++i) EXPECT_EQ(test::post(small, "/jobs", scene).status, 202) << i;
}

TEST_F(Body, body_is_taken_whole_whatever_its_length) {
  for (const std::size_t length : {65'535UL, 65'536UL, 65'537UL, 600'000UL, 10'000'000UL}) {
    std::string padded = small_scene;
    padded.resize(length - 1, ' ');
    EXPECT_EQ(post("/render", padded + "\n").status, 200) << length;
    EXPECT_EQ(post("/render", padded + "x").status, 400) << length;
  }
}

}  // namespace
}  // namespace raytracer::test
