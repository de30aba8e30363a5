// The log: one line per request that a program can read, under an id that the client knows too.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <set>
#include <string>
#include <vector>

#include "tests/process/patience.h"
#include "tests/service/documents.h"
#include "tests/service/raw_connection.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

std::string id_of(const Answer& answer) { return answer.get_header_value("X-Request-Id"); }

/// The log's only line with `text`, once it is there; fails the test if it does not come.
std::string line_with(const ServerProcess& server, const std::string& text) {
  EXPECT_TRUE(eventually([&] { return server.log().find(text) != std::string::npos; }, 5s))
      << text << " is not in\n"
      << server.log();
  const std::string log = server.log();
  const std::size_t at = log.find(text);
  if (at == std::string::npos) return {};
  EXPECT_EQ(log.find(text, at + 1), std::string::npos) << "twice: " << text;
  const std::size_t begin = log.rfind('\n', at) + 1;
  return log.substr(begin, log.find('\n', at) - begin);
}

TEST(Log, has_a_line_for_each_request) {
  const ServerProcess server;
  const Answer answer = post(server, "/render?width=20", small_scene);
  const std::string line = line_with(server, "id=" + id_of(answer) + " ");
  for (const char* const field : {" request=\"POST /render?width=20\" ", " status=200 ",
                                  " duration_ms=", " bytes=", " client=127.0.0.1"})
    EXPECT_NE(line.find(field), std::string::npos) << field << " is not in " << line;
  EXPECT_EQ(server.log().find("camera"), std::string::npos) << "the body is in the log";
}

TEST(Log, says_no_token) {
  const ServerProcess server({"--token", "secret-word"});
  const Answer answer = get(server, "/scenes", {{"Authorization", "Bearer secret-word"}});
  EXPECT_EQ(answer.status, 200);
  EXPECT_NE(line_with(server, id_of(answer)), "");
  EXPECT_EQ(server.log().find("secret-word"), std::string::npos);
}

TEST(Log, line_is_one_line_whatever_is_asked_for) {
  const ServerProcess server;
  const Answer answer = get(server, "/scenes?x\x01\" status=999\n");
  const std::string line = line_with(server, id_of(answer));
  EXPECT_NE(line.find("GET /scenes"), std::string::npos) << line;
  EXPECT_EQ(line.find('\x01'), std::string::npos) << line;
  EXPECT_EQ(line.find(" status=999"), std::string::npos) << line;
}

TEST(Log, quiet_server_says_nothing) {
  ServerProcess server({"--quiet"});
  EXPECT_NE(id_of(get(server, "/scenes")), "");
  server.signal(SIGTERM);  // a line is written after its answer, but before the end
  ASSERT_EQ(server.wait(), 0);
  EXPECT_EQ(server.log().find("request="), std::string::npos) << server.log();
}

TEST(RequestId, is_in_every_answer_and_never_twice) {
  const ServerProcess server;
  std::set<std::string> ids;
  const std::vector<Answer> answers{get(server, "/healthz"),
                                    get(server, "/healthz"),
                                    get(server, "/nothing"),
                                    request(server, "PUT", "/render"),
                                    request(server, "HEAD", "/"),
                                    post(server, "/render", "{}"),
                                    get(server, "/" + std::string(3000, 'a'))};
  for (const Answer& answer : answers) {
    EXPECT_EQ(answer.get_header_value_count("X-Request-Id"), 1U) << answer.status;
    ids.insert(id_of(answer));
  }
  EXPECT_EQ(ids.size(), answers.size());
  RawConnection nonsense(server.port());
  nonsense.send("GET / HTTP/9.9\r\n\r\n");
  EXPECT_TRUE(nonsense.receives("X-Request-Id: ", 5s)) << nonsense.received();
}

TEST(RequestId, is_the_clients_if_that_is_plain) {
  const ServerProcess server;
  const std::string plain = "0b5e7c4a-93d1:web_2.1";
  EXPECT_EQ(id_of(get(server, "/scenes", {{"X-Request-Id", plain}})), plain);
  EXPECT_NE(line_with(server, "id=" + plain + " "), "");
  for (const std::string& odd :
       {std::string("two words"), std::string("\"quoted\""), std::string(65, 'a'),
        std::string("a\tb"), std::string("\xc3\xa4")})
    EXPECT_NE(id_of(get(server, "/scenes", {{"X-Request-Id", odd}})), odd);
}

}  // namespace
}  // namespace raytracer::test
