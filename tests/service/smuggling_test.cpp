// Requests that two readers would end at different places: behind a proxy, what one takes for a
// body is the next request to the other. Each must be refused and its connection closed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "tests/process/patience.h"
#include "tests/service/raw_connection.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

using Smuggling = Service;

const std::string hidden = "GET /healthz HTTP/1.1\r\nHost: x\r\n\r\n";

TEST_F(Smuggling, request_whose_end_is_in_doubt_is_refused_and_nothing_in_it_answered) {
  const std::string post = "POST /render HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n";
  const std::string get = "GET /healthz HTTP/1.1\r\nHost: x\r\n";
  const std::string length = fmt::format("Content-Length: {}\r\n", hidden.size());
  const std::string no_chunk = "\r\n0\r\n\r\n";
  const std::vector<std::pair<std::string, std::string>> requests{
      {"folded coding", post + "Transfer-Encoding:\r\n chunked\r\n" + length + "\r\n"},
      {"folded length", post + "X: y\r\n Content-Length: 0\r\n" + length + "\r\n"},
      {"coding nobody knows", post + "Transfer-Encoding: xchunked\r\nContent-Length: 4\r\n\r\n"},
      {"coding behind a tab", post + "Transfer-Encoding\t: chunked\r\nContent-Length: 4\r\n\r\n"},
      {"coding of HTTP/1.0",
       "POST /render HTTP/1.0\r\nHost: x\r\nTransfer-Encoding: chunked\r\n" + no_chunk},
      {"coding beside a named scene",
       "POST /render?scene=demo HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n" + no_chunk},
      {"lines without a return", "POST /render HTTP/1.1\nHost: x\n" + length + "\n"},
      {"line break in a value", get + "X: a\n" + length + "\r\n"},
      {"return in a value", post + "X: y\rContent-Length: 0\r\n" + length + "\r\n"},
      {"length with a sign", post + "Content-Length: +33\r\n\r\n"},
      {"length in hexadecimal", post + "Content-Length: 0x21\r\n\r\n"},
      {"length as a list", post + "Content-Length: 33, 33\r\n\r\n"},
      {"length without a colon", post + "Content-Length 33\r\n\r\n"},
      {"body of a GET", get + length + "\r\n"},
      {"body of a GET that says first that it has none",
       get + "Content-Length: 0\r\n" + length + "\r\n"},
      {"chunks of a GET", get + "Transfer-Encoding: chunked\r\n" + no_chunk},
      {"body of a HEAD", "HEAD /healthz HTTP/1.1\r\nHost: x\r\n" + length + "\r\n"},
      {"body of a DELETE", "DELETE /jobs/1 HTTP/1.1\r\nHost: x\r\n" + length + "\r\n"},
      {"body of a PUT", "PUT /render HTTP/1.1\r\nHost: x\r\n" + length + "\r\n"},
      {"chunks of a PATCH",
       "PATCH /render HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n" + no_chunk},
      {"two hosts", "GET /healthz HTTP/1.1\r\nHost: x\r\nHost: y\r\n" + length + "\r\n"}};
  for (const auto& [name, request] : requests) {
    RawConnection connection(server().port());
    connection.send(request + hidden);
    EXPECT_TRUE(connection.ends(15s)) << name;
    EXPECT_EQ(count_answers(connection.received()), 1) << name << ": " << connection.received();
    EXPECT_EQ(connection.received().rfind("HTTP/1.1 4", 0), 0U)
        << name << ": " << connection.received();
    EXPECT_EQ(connection.received().find("\"ok\""), std::string::npos) << name;
  }
}

TEST_F(Smuggling, request_without_one_host_is_400) {
  for (const std::string& hosts : {std::string(), std::string("Host: x\r\nHost: x\r\n")}) {
    RawConnection connection(server().port());
    connection.send("GET /healthz HTTP/1.1\r\n" + hosts + "Connection: close\r\n\r\n");
    EXPECT_TRUE(connection.ends(15s));
    EXPECT_EQ(connection.received().rfind("HTTP/1.1 400 ", 0), 0U) << connection.received();
  }
}

}  // namespace
}  // namespace raytracer::test
