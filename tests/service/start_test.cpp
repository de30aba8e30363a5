// Flags, variables and ports: what the server starts with, and what it refuses to start with.
#include <gtest/gtest.h>

#include <csignal>
#include <map>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "tests/process/patience.h"
#include "tests/process/program.h"
#include "tests/service/documents.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

using Environment = std::map<std::string, std::string>;

Outcome run_server(std::vector<std::string> flags, Environment environment = {}) {
  return run({RAYTRACER_SERVER_PATH, std::move(flags), "", std::move(environment)});
}

void expect_refusal(const Outcome& outcome, const std::string& says) {
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("terminate called"), std::string::npos) << outcome.err;
}

TEST(Start, says_where_it_listens_in_one_line) {
  const ServerProcess server;
  static const std::regex line(R"(listening on http://127\.0\.0\.1:\d+\n)");
  EXPECT_TRUE(std::regex_match(server.out(), line)) << server.out();
  EXPECT_EQ(get(server, "/healthz").status, 200);
}

TEST(Start, taken_port_is_an_error) {
  const ServerProcess first;
  const std::string port = std::to_string(first.port());
  const Outcome second = run_server({"--port", port});
  expect_refusal(second, "127.0.0.1:" + port);
  EXPECT_NE(second.err.find("--port"), std::string::npos) << second.err;
  EXPECT_EQ(get(first, "/healthz").status, 200);
}

TEST(Start, port_of_a_server_that_ended_is_free_again) {
  std::string port;
  {
    ServerProcess first;
    port = std::to_string(first.port());
    EXPECT_EQ(get(first, "/healthz").status, 200);
    first.signal(SIGTERM);
    ASSERT_EQ(first.wait(), 0);
  }
  Process second({RAYTRACER_SERVER_PATH, {"--port", port}});
  EXPECT_TRUE(eventually([&] { return second.out().find(":" + port) != std::string::npos; }))
      << second.err();
}

TEST(Start, wrong_flags_are_refused_with_their_name_and_range) {
  const std::vector<std::pair<std::string, std::string>> table{
      {"--port", "65536"},
      {"--port", "-1"},
      {"--port", "http"},
      {"--port", ""},
      {"--threads", "0"},
      {"--threads", "two"},
      {"--max-body", "0"},
      {"--max-pixels", "0"},
      {"--max-objects", "1.5"},
      {"--max-lights", "0"},
      {"--max-samples", "-2"},
      {"--max-work", "1e9"},
      {"--max-work", "99999999999999999999"},
      {"--max-queue", "-1"},
      {"--token", ""},
      {"--token", "two words"},
      {"--host", ""}};
  for (const auto& [flag, value] : table) {
    SCOPED_TRACE(testing::PrintToString(std::pair(flag, value)));
    expect_refusal(run_server({flag, value}), flag);
  }
  expect_refusal(run_server({"--prot", "0"}), "'--prot' is no flag");
  expect_refusal(run_server({"scene.json"}), "scene.json");
  expect_refusal(run_server({"--port"}), "--port");
  expect_refusal(run_server({"--port", "0", "--port", "1"}), "--port");
  expect_refusal(run_server({"--allow-origin", "http://x", "http://y"}), "http://y");
}

TEST(Start, wrong_variables_are_refused_with_their_name) {
  for (const char* const variable :
       {"RAYTRACER_PORT", "RAYTRACER_THREADS", "RAYTRACER_MAX_BODY", "RAYTRACER_MAX_PIXELS",
        "RAYTRACER_MAX_OBJECTS", "RAYTRACER_MAX_LIGHTS", "RAYTRACER_MAX_SAMPLES",
        "RAYTRACER_MAX_WORK", "RAYTRACER_MAX_QUEUE"})
    expect_refusal(run_server({}, {{variable, "many"}}), variable);
}

TEST(Start, address_that_is_not_this_machines_is_refused) {
  expect_refusal(run_server({"--host", "192.0.2.1", "--port", "0", "--token", "secret"}),
                 "192.0.2.1");
  expect_refusal(run_server({"--host", "no.such.host.invalid", "--port", "0", "--token", "secret"}),
                 "no.such.host.invalid");
}

TEST(Start, variable_sets_what_no_flag_does) {
  const ServerProcess server({"--max-samples", "6"},
                             {{"RAYTRACER_MAX_PIXELS", "900"}, {"RAYTRACER_MAX_SAMPLES", "5"}});
  EXPECT_EQ(post(server, "/render", square_scene(31, 1)).status, 413);
  EXPECT_EQ(post(server, "/render", square_scene(30, 6)).status, 200);
  EXPECT_EQ(post(server, "/render", square_scene(30, 7)).status, 413);
}

TEST(Start, empty_variable_counts_as_not_set) {
  const ServerProcess server({}, {{"RAYTRACER_THREADS", ""}, {"RAYTRACER_TOKEN", ""}});
  EXPECT_EQ(get(server, "/scenes").status, 200);
}

TEST(Start, help_names_every_flag_and_variable) {
  const Outcome help = run_server({"--help"});
  EXPECT_EQ(help.status, 0);
  for (const char* const name :
       {"--host", "--port", "--threads", "--max-body", "--max-pixels", "--max-objects",
        "--max-lights", "--max-samples", "--max-work", "--max-queue", "--token", "--allow-origin",
        "RAYTRACER_HOST", "RAYTRACER_PORT", "RAYTRACER_THREADS", "RAYTRACER_MAX_BODY",
        "RAYTRACER_MAX_QUEUE", "RAYTRACER_TOKEN"})
    EXPECT_NE(help.out.find(name), std::string::npos) << name;
}

#ifdef RAYTRACER_HAS_JEMALLOC
TEST(Start, jemalloc_allocates_as_the_server_wants_it) {
  ServerProcess server({}, {{"MALLOC_CONF", "stats_print:true"}});  // when it ends
  server.signal(SIGTERM);
  EXPECT_EQ(server.wait(), 0);
  EXPECT_NE(server.log().find("opt.oversize_threshold: 67108864"), std::string::npos)
      << server.log().substr(0, 5000);
}
#endif

TEST(Start, version_is_printed) {
  const Outcome outcome = run_server({"--version"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out.rfind("raytracer-server ", 0), 0U) << outcome.out;
}

}  // namespace
}  // namespace raytracer::test
