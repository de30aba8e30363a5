// Paths and methods: what is nowhere, what is not allowed, and requests made to hurt.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/problem.h"
#include "server/route_table.h"
#include "tests/process/patience.h"
#include "tests/service/raw_connection.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

class Routing : public Service {
 protected:
  /// What the server answers to these bytes, up to the connection's end.
  static std::string raw(const std::string& bytes) {
    RawConnection connection(server().port());
    connection.send(bytes);
    EXPECT_TRUE(connection.ends(15s)) << "the connection stays open: " << connection.received();
    return connection.received();
  }
};

TEST_F(Routing, unknown_paths_are_404) {
  for (const char* const path :
       {"/nothing", "/render/", "/scenes/", "/scenes/a/b", "/jobs/", "//", "/../server/main.cpp",
        "/web/index.html", "/%2e%2e/CMakeLists.txt", "/schema"})
    expect_problem(get(path), 404, "");
  expect_problem(get("/scenes/dmo"), 404, "\"demo\"");
}

TEST_F(Routing, unknown_path_is_told_of_the_page_if_there_is_one) {
  expect_problem(get("/nothing"), 404, "the page is at /");
  const RouteTable of_a_worker({{"GET", "/healthz", RequestBody::none, {}}});
  try {
    of_a_worker.match("GET", "/nothing");
    ADD_FAILURE() << "it was found";
  } catch (const HttpError& refusal) {
    EXPECT_EQ(refusal.problem().status, 404);
    EXPECT_EQ(refusal.problem().detail, "There is nothing at /nothing");
  }
}

TEST_F(Routing, other_methods_are_405_with_those_that_are_allowed) {
  const Answer deleted = request("DELETE", "/render");
  expect_problem(deleted, 405, "/render");
  EXPECT_EQ(deleted.get_header_value("Allow"), "POST, GET, HEAD");
  const Answer put = request("PUT", "/healthz");
  EXPECT_EQ(put.status, 405);
  EXPECT_EQ(put.get_header_value("Allow"), "GET, HEAD");
  const Answer posted = post("/version", "{}");
  EXPECT_EQ(posted.status, 405);
  EXPECT_EQ(posted.get_header_value("Allow"), "GET, HEAD");
}

TEST_F(Routing, unknown_method_is_an_error_not_a_crash) {
  const std::string answer = raw("BREW /render HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n");
  EXPECT_EQ(answer.rfind("HTTP/1.1 405", 0), 0U) << answer;
  EXPECT_NE(answer.find("Allow: POST, GET, HEAD\r\n"), std::string::npos) << answer;
  EXPECT_EQ(raw("BREW /nothing?a=b HTTP/1.1\r\n\r\n").rfind("HTTP/1.1 404", 0), 0U);
  EXPECT_EQ(raw("BREW2 http://x/render HTTP/1.1\r\n\r\n").rfind("HTTP/1.1 405", 0), 0U);
  for (const char* const line : {"BREW? /render HTTP/1.1\r\n\r\n", "hello world\r\n\r\n",
                                 "BREW /render\r\n\r\n", "BREW /render HTTP/9\r\n\r\n"})
    EXPECT_EQ(raw(line).rfind("HTTP/1.1 400", 0), 0U) << line;
  EXPECT_EQ(get("/healthz").status, 200);
}

TEST_F(Routing, target_with_scheme_and_host_is_its_path) {
  for (const auto& [target, status] : {std::pair{"http://x/healthz", 200},
                                       {"http://x:80/render?scene=demo&width=8&height=8", 200},
                                       {"HTTP://x/healthz", 200},
                                       {"http://x", 200},
                                       {"http://x?a=b", 200},
                                       {"http://x/nothing", 404},
                                       {"http:/healthz", 404},
                                       {"ftp://x/healthz", 404}}) {
    const std::string answer =
        raw(fmt::format("GET {} HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", target));
    EXPECT_EQ(answer.rfind(fmt::format("HTTP/1.1 {}", status), 0), 0U) << target << ": " << answer;
  }
}

TEST_F(Routing, endless_path_is_414) {
  const std::string path = fmt::format("/{:a>{}}", "", 100'000);
  const std::string answer = raw("GET " + path + " HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_EQ(answer.rfind("HTTP/1.1 414 ", 0), 0U) << answer.substr(0, 300);
  EXPECT_EQ(get("/healthz").status, 200);
}

TEST_F(Routing, long_paths_are_414_at_every_length) {
  for (const std::size_t length : {3000U, 7000U, 8100U}) {
    const Answer answer = get(fmt::format("/{:a>{}}", "", length));
    expect_problem(answer, 414, "");
  }
  const Answer query = get("/render?scene=" + std::string(6000, 'a'));
  EXPECT_EQ(query.status, 414);
}

TEST_F(Routing, header_without_end_is_refused) {
  std::string request = "GET /healthz HTTP/1.1\r\nHost: x\r\n";
  for (int i = 0; i < 20'000; ++i) request += "X-Filler-" + std::to_string(i) + ": x\r\n";
  raw(request + "\r\n");
  raw("GET /healthz HTTP/1.1\r\nHost: x\r\nX-Long: " + std::string(1'000'000, 'x') + "\r\n\r\n");
  EXPECT_EQ(get("/healthz").status, 200);
}

TEST_F(Routing, nonsense_is_refused) {
  for (const std::string& bytes :
       {std::string("hello\r\n\r\n"), std::string("\x16\x03\x01\x02\x00\x01\x00\r\n\r\n", 11),
        std::string("GET / HTTP/9.9\r\n\r\n"), std::string("GET\r\n\r\n"),
        std::string("\r\n\r\n\r\n"), std::string(4096, '\0') + "\r\n\r\n"}) {
    const std::string answer = raw(bytes);
    EXPECT_TRUE(answer.empty() || answer.rfind("HTTP/1.1 4", 0) == 0) << answer;
  }
  EXPECT_EQ(get("/healthz").status, 200);
}

TEST_F(Routing, field_name_with_a_space_is_refused) {
  const std::string answer =
      raw("GET /healthz HTTP/1.1\r\nHost: x\r\nX-Thing : 1\r\nConnection: close\r\n\r\n");
  EXPECT_EQ(answer.rfind("HTTP/1.1 400 ", 0), 0U) << answer;
}

TEST_F(Routing, silent_connections_do_not_keep_others_waiting) {
  // Far more than threads would be kept ready; the server has as many descriptors as this program.
  rlimit descriptors{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &descriptors), 0);
  const std::size_t count = std::min<std::size_t>(2000, descriptors.rlim_cur - 200);
  std::vector<std::unique_ptr<RawConnection>> silent(count);
  for (auto& connection : silent) connection = std::make_unique<RawConnection>(server().port());
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(get("/healthz").status, 200);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, patience(2s));
}

TEST_F(Routing, slow_header_does_not_hold_a_connection_for_ever) {
  RawConnection connection(server().port());
  connection.send("GET /healthz HTTP/1.1\r\nHo");
  EXPECT_TRUE(connection.ends(15s)) << "the server still waits for the rest of a header";
}

TEST_F(Routing, range_requests_are_answered_whole) {
  for (const char* const range : {"bytes=0-9,0-9,5-20", "lines=1-2", "nonsense"}) {
    const Answer answer = get("/schema/scene.json", {{"Range", range}});
    EXPECT_EQ(answer.status, 200) << range;
    EXPECT_EQ(request("HEAD", "/schema/scene.json", {{"Range", range}}).status, 200) << range;
    EXPECT_EQ(answer.body, get("/schema/scene.json").body) << range;
    const Answer nothing = get("/nothing", {{"Range", range}});
    expect_problem(nothing, 404, "/nothing");
    EXPECT_EQ(nothing.get_header_value_count("X-Request-Id"), 1U);
  }
}

TEST_F(Routing, server_as_a_whole_says_its_methods) {
  const std::string answer = raw("OPTIONS * HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 204 ")) << answer;
  EXPECT_NE(answer.find("\r\nAllow: POST, GET, HEAD, DELETE\r\n"), std::string::npos) << answer;
}

TEST_F(Routing, closed_connection_is_announced_once) {
  for (const char* const target : {"GET /healthz", "POST /render"}) {
    const std::string answer =
        raw(fmt::format("{} HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", target));
    const std::size_t first = answer.find("\r\nConnection: close\r\n");
    ASSERT_NE(first, std::string::npos) << answer;
    EXPECT_EQ(answer.find("\r\nConnection: ", first + 1), std::string::npos) << answer;
  }
}

TEST_F(Routing, texts_are_compressed_for_those_who_accept_it) {
  const auto coding = [](const char* accepted) {
    return raw(fmt::format("GET /scenes HTTP/1.1\r\nHost: x\r\nConnection: close\r\n"
                           "Accept-Encoding: {}\r\n\r\n",
                           accepted))
               .find("\r\nContent-Encoding: ") != std::string::npos;
  };
  EXPECT_TRUE(coding("gzip"));
  EXPECT_TRUE(coding("br;q=0, gzip;q=0.5"));
  for (const char* const none : {"gzip;q=0", "br;q=0, gzip;q=0.000", "identity"})
    EXPECT_FALSE(coding(none)) << none;
}

}  // namespace
}  // namespace raytracer::test
