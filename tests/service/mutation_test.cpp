// Ten thousand requests that are almost right: valid ones with a few bytes or values changed, on
// connections that stay open for as long as the server lets them. None may be a crash, a 5xx or a
// hang, nor change what others are answered.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <random>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "tests/process/patience.h"
#include "tests/process/process_figures.h"
#include "tests/service/documents.h"
#include "tests/service/raw_connection.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

constexpr int request_count = 10'000;
constexpr int client_count = 8;

struct Parts {
  std::string head;  ///< without the empty line, and without the body's length
  std::string body{};

  std::string whole() const {
    if (body.empty()) return head + "\r\n";
    return fmt::format("{}Content-Length: {}\r\n\r\n{}", head, body.size(), body);
  }
};

Parts posted(std::string_view target, const std::string& body, std::string_view fields = "") {
  return {fmt::format("POST {} HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n{}", target,
                      fields),
          body};
}

/// `job` is the path of one, and is deleted by the last of them.
std::vector<Parts> valid_requests(const std::string& job) {
  const std::string everything = R"({
    "camera": {"origin": [0, 1, -5], "look_at": [0, 0, 0], "up": [0, 1, 0], "fov": 0.9,
               "width": 16, "height": 12},
    "background": "#204080", "ambient": 0.2, "shadows": "ambient",
    "lights": [{"type": "point", "position": [3, 4, -5], "color": [1, 1, 1], "intensity": 0.8}],
    "materials": {"red": {"color": "#e03020", "reflectivity": 0.3, "shininess": 20}},
    "objects": [{"type": "sphere_square", "center": [0, -1, 0], "radius": 0.2, "n": 6},
                {"type": "spheres", "centers": [[0, 0, 0], [1, 0, 0]], "radius": [0.5, 0.2]},
                {"type": "plane", "point": [0, -2, 0], "normal": [0, 1, 0], "material": "red"},
                {"type": "mesh", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]],
                 "triangles": [[0, 1, 2]]}],
    "render": {"samples": 2, "precision": "auto", "transfer": "srgb", "max_depth": 3}})";
  return {posted("/render", small_scene),
          posted("/render?width=16&height=9&samples=2&precision=double", everything),
          posted("/render?target_rmse=0.05", everything, "Accept: image/x-portable-pixmap\r\n"),
          posted("/render?budget_ms=2", small_scene, "Accept: image/*;q=0.5, */*;q=0.1\r\n"),
          posted("/plan", everything),
          posted("/jobs?samples=3", everything),
          posted("/scenes", everything),
          posted("/render", small_scene, "Cache-Control: no-cache\r\nIf-None-Match: \"x\", *\r\n"),
          posted("/render?scene=first-sphere&width=9&height=7", ""),
          {"GET /render?scene=demo&width=16&height=12&origin=0,2,-9&fov=0.7 HTTP/1.1\r\nHost: x\r\n"
           "Range: bytes=0-9\r\nX-Request-Id: abc\r\n"},
          {"GET /scenes/demo HTTP/1.1\r\nHost: x\r\nAccept-Encoding: gzip, br\r\n"},
          {"HEAD /metrics HTTP/1.1\r\nHost: x\r\nAuthorization: Bearer abc\r\n"},
          {"GET /openapi.json HTTP/1.1\r\nHost: x\r\nConnection: keep-alive\r\n"},
          {"OPTIONS /jobs HTTP/1.1\r\nHost: x\r\nOrigin: http://x\r\n"
           "Access-Control-Request-Method: POST\r\n"},
          {fmt::format("GET {}/events HTTP/1.1\r\nHost: x\r\n", job)},
          {fmt::format("DELETE {} HTTP/1.1\r\nHost: x\r\n", job)}};
}

class Mutator {
 public:
  Mutator(unsigned seed, std::vector<Parts> requests)
      : random_(seed), requests_(std::move(requests)) {}

  /// Mostly with a length that is the body's: what is wrong is then found behind the first
  /// validation.
  std::string next() {
    Parts parts = requests_[below(requests_.size())];
    const std::size_t changes = 1 + below(3);
    if (below(4) == 0) {
      std::string whole = parts.whole();
      for (std::size_t i = 0; i < changes; ++i) change(whole);
      return whole;
    }
    for (std::size_t i = 0; i < changes; ++i)
      change(parts.body.empty() || below(5) == 0 ? parts.head : parts.body);
    return parts.whole();
  }

 private:
  std::size_t below(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
  }

  void change(std::string& request) {
    if (request.empty()) return;
    const std::size_t at = below(request.size());
    const std::size_t length = below(20);
    switch (below(14)) {
      case 0:
        request[at] = static_cast<char>(below(256));
        break;
      case 1:
        request[at] = static_cast<char>(static_cast<unsigned char>(request[at]) ^ 1U << below(8));
        break;
      case 2:
        request.insert(at, 1, static_cast<char>(below(256)));
        break;
      case 3:
        request.erase(at, length);
        break;
      case 4:
        request.insert(below(request.size()), request.substr(at, length));
        break;
      case 5:
        request.resize(at);
        break;
      default:
        replace_word(request, at);
    }
  }

  /// The word or number at or behind `at` becomes another one.
  void replace_word(std::string& request, std::size_t at) {
    constexpr std::string_view word =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789.-";
    constexpr std::array<std::string_view, 22> others{
        "0",       "-1",   "1e308", "1e-308", "1e999", "4294967296", "9223372036854775808",
        "NaN",     "null", "true",  "\"\"",   "[]",    "{}",         "chunked",
        "gzip",    "0x10", "100",   "scene",  "%00",   "../../etc",  "\xff\xfe",
        "HTTP/1.0"};
    const std::size_t begin = request.find_first_of(word, at);
    if (begin == std::string::npos) return;
    const std::size_t end = request.find_first_not_of(word, begin);
    request.replace(begin, end == std::string::npos ? end : end - begin,
                    others[below(others.size())]);
  }

  std::mt19937 random_;
  const std::vector<Parts> requests_;
};

/// The number behind a field's name in an answer's head, -1 without it.
int number_behind(std::string_view head, std::string_view name) {
  const std::size_t at = head.find(name);
  int number = -1;
  if (at != std::string_view::npos)
    std::from_chars(head.data() + at + name.size(), head.data() + head.size(), number);
  return number;
}

/// One client: a connection that it opens again whenever the server, or what it sent, ended it.
class Client {
 public:
  explicit Client(int port) : port_(port) {}

  /// The answer's status; 0 if there is none, which is right where the request has no end.
  int ask(const std::string& request, std::chrono::milliseconds limit = 30ms) {
    if (!connection_) connection_ = std::make_unique<RawConnection>(port_);
    connection_->forget();
    const bool was_sent = connection_->send(request);
    if (!connection_->receives("\r\n\r\n", limit)) {
      connection_.reset();
      return 0;
    }
    const std::string head =
        connection_->received().substr(0, connection_->received().find("\r\n\r\n") + 4);
    const int status = number_behind(head, "HTTP/1.1 ");
    const int length = number_behind(head, "Content-Length: ");
    const bool goes_on =
        was_sent && length >= 0 && head.find("Connection: close") == std::string::npos &&
        connection_->receives(head.size() + static_cast<std::size_t>(length), limit);
    if (!goes_on) connection_.reset();
    return status;
  }

 private:
  const int port_;
  std::unique_ptr<RawConnection> connection_;
};

unsigned chosen_seed() {
  const char* const given = std::getenv("RAYTRACER_TEST_SEED");
  return given ? static_cast<unsigned>(std::strtoul(given, nullptr, 10)) : 6;
}

TEST(Mutation, requests_are_answered_and_harm_nobody) {
  const unsigned seed = chosen_seed();
  // What a request may ask for is small, so that there is time for many.
  ServerProcess server({"--max-pixels", "20000", "--max-samples", "64", "--max-work", "1000000",
                        "--max-body", "100000", "--allow-origin", "*", "--quiet"});
  const std::string picture = post(server, "/render", small_scene).body;
  const std::vector<Parts> valid =
      valid_requests(post(server, "/jobs", small_scene).get_header_value("Location"));
  for (const Parts& parts : valid) {
    const int status = Client(server.port()).ask(parts.whole(), 5s);
    ASSERT_TRUE(status >= 200 && status < 400) << status << " to " << parts.whole();
  }

  std::mutex mutex;
  std::map<int, int> counts;
  const auto begin = std::chrono::steady_clock::now();
  std::vector<std::thread> clients;
  clients.reserve(client_count);
  for (int i = 0; i < client_count; ++i)
    clients.emplace_back([&, i] {
      Mutator mutator(seed + static_cast<unsigned>(i), valid);
      Client client(server.port());
      for (int k = 0; k < request_count / client_count; ++k) {
        const std::string request = mutator.next();
        const int status = client.ask(request);
        const std::scoped_lock lock(mutex);
        ++counts[status];
        EXPECT_TRUE(status < 500 || status == 503)
            << status << " to " << testing::PrintToString(request);
      }
    });
  for (std::thread& client : clients) client.join();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;

  std::string line = fmt::format("seed {} (RAYTRACER_TEST_SEED), {:.1f} s;", seed, took.count());
  for (const auto& [status, count] : counts) line += fmt::format(" {}: {}", status, count);
  const int answered = request_count - counts[0];  // on a busy machine fewer, in 30 ms
  EXPECT_GT(answered, request_count / 2);
  EXPECT_GT(counts[200], answered / 20) << "mutations leave nothing of the requests";
  EXPECT_GT(counts[422], answered / 20) << "mutations do not reach the scenes";
  EXPECT_EQ(post(server, "/render", small_scene, {{"Cache-Control", "no-cache"}}).body, picture);
  const std::optional<ProcessFigures> figures = figures_of(server.id());
  if (figures && speed_counts) {
    EXPECT_LT(figures->peak_kb, 600 << 10);
    line += fmt::format("; peak {} kB", figures->peak_kb);
  }
  std::cout << line << "\n";
  server.signal(SIGTERM);
  EXPECT_EQ(server.wait(), 0) << server.log();
}

}  // namespace
}  // namespace raytracer::test
