#include "tests/measure/soak/traffic.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "tests/process/endless_scene.h"
#include "tests/service/raw_connection.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

/// A row of spheres before blue; another scene for each pair of numbers.
std::string scene(int round, int number, int sphere_count) {
  std::string text = fmt::format(
      R"({{"camera": {{"origin": [0, 2, -9], "look_at": [0, 0, 0], "fov": 0.9,
           "width": 96, "height": 72}},
           "lights": [{{"type": "distant", "direction": [-1, -2, 1]}}], "objects": [)");
  for (int i = 0; i < sphere_count; ++i)
    fmt::format_to(std::back_inserter(text),
                   R"({}{{"type": "sphere", "center": [{}, {}, {}], "radius": 0.2}})",
                   i == 0 ? "" : ",", i % 20 - 10, number % 1000, round + i / 20);
  return text + "]}";
}

/// What stands behind `name` in a JSON answer; empty if it is none.
std::string text_at(const std::string& body, const char* name) {
  const auto json = nlohmann::json::parse(body, nullptr, false);
  return json.is_object() ? json.value(name, "") : "";
}

}  // namespace

Traffic::Traffic(const ServerProcess& server, int round) : server_(server), round_(round) {
  const auto start = [this](Client client, std::chrono::milliseconds pause) {
    clients_.emplace_back([this, client, pause] { repeat(client, pause); });
  };
  for (int i = 0; i < 3; ++i) start(&Traffic::render, 20ms);
  start(&Traffic::keep_a_scene, 50ms);
  start(&Traffic::follow_a_job, 100ms);
  start(&Traffic::cancel_a_job, 300ms);
  start(&Traffic::send_nonsense, 30ms);
  start(&Traffic::leave, 300ms);
}

Traffic::~Traffic() {
  stop_ = true;
  for (std::thread& client : clients_) client.join();
}

StatusCounts Traffic::counts() const {
  const std::scoped_lock lock(mutex_);
  return counts_;
}

void Traffic::repeat(Client client, std::chrono::milliseconds pause) {
  for (int number = 0; !stop_; ++number) {
    (this->*client)(number);
    std::this_thread::sleep_for(pause);
  }
}

void Traffic::note(int status) {
  const std::scoped_lock lock(mutex_);
  ++counts_[status];
}

/// The answer's body. Without keep-alive: each request is a connection.
std::string Traffic::send(const std::string& method, const std::string& target,
                          const std::string& body) {
  httplib::Client client = server_.client();
  httplib::Request request;
  request.method = method;
  request.path = target;
  request.body = body;
  if (!body.empty()) request.headers.emplace("Content-Type", "application/json");
  const httplib::Result answer = client.send(request);
  note(answer ? answer->status : 0);
  return answer ? answer->body : "";
}

/// On one connection: new pictures and such as were asked for before, in several formats.
void Traffic::render(int number) {
  httplib::Client client = server_.client();
  client.set_keep_alive(true);
  constexpr std::array<const char*, 3> types{"image/png", "image/x-portable-pixmap",
                                             "image/x-portable-floatmap"};
  for (int i = 0; i < 10; ++i) {
    const httplib::Headers headers{{"Accept", types[static_cast<std::size_t>(i) % types.size()]}};
    const std::string size = fmt::format("?width={}&height={}", 32 << (i % 4), 24 << (i % 4));
    const auto answer = client.Post("/render" + size, headers,
                                    scene(round_, i % 2 == 0 ? number : 0, 50), "application/json");
    note(answer ? answer->status : 0);
  }
  send("GET", "/render?scene=demo&width=200&height=150&samples=4");
  send("POST", "/plan", scene(round_, number, 5));
  send("GET", "/metrics");
}

void Traffic::keep_a_scene(int number) {
  const std::string id = text_at(send("POST", "/scenes", scene(round_, number, 1000)), "id");
  for (int i = 0; i < 3; ++i)
    send("GET", fmt::format("/render?scene={}&width=64&height=48&origin=0,2,-{}", id, 7 + i));
  send("GET", "/scenes/" + id);
}

void Traffic::follow_a_job(int number) {
  const std::string task = number % 20 == 0 ? "?task=tradeoff&width=32&height=24" : "?samples=16";
  const std::string id = text_at(send("POST", "/jobs" + task, scene(round_, number, 5)), "id");
  send("GET", fmt::format("/jobs/{}/events", id));
  send("GET", fmt::format("/jobs/{}", id));
  send("GET", fmt::format("/jobs/{}/{}", id, number % 20 == 0 ? "result" : "image"));
}

void Traffic::cancel_a_job(int number) {
  const std::string id = text_at(send("POST", "/jobs?width=640&height=480", endless_scene()), "id");
  std::this_thread::sleep_for(std::chrono::milliseconds(10 * (number % 10)));
  send("GET", fmt::format("/jobs/{}/image", id));
  {
    RawConnection listener(server_.port());
    listener.send(fmt::format("GET /jobs/{}/events HTTP/1.1\r\nHost: x\r\n\r\n", id));
    listener.receives("event: progress", 200ms);
  }
  send("DELETE", "/jobs/" + id);
}

void Traffic::send_nonsense(int number) {
  constexpr std::array<std::string_view, 8> nonsense{
      "hello\r\n\r\n",
      "GET /nowhere HTTP/1.1\r\nHost: x\r\n\r\n",
      "POST /render HTTP/1.1\r\nHost: x\r\nContent-Length: 9\r\n\r\n{\"camera\"",
      "POST /render HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: "
      "chunked\r\n\r\n5\r\nhello\r\n0\r\n\r\n",
      "POST /render HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
      "Content-Length: 3\r\n\r\n[1,",
      "POST /render HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
      "Content-Length: 99999999999\r\n\r\n{",
      "GET /render?scene=demo&width=1000000&height=1000000 HTTP/1.1\r\nHost: x\r\n\r\n",
      "GET / HTTP/1.1\r\nHo"};
  RawConnection connection(server_.port());
  connection.send(nonsense[static_cast<std::size_t>(number) % nonsense.size()]);
  connection.receives("HTTP/1.1 ", 20ms);
  const std::string& answer = connection.received();
  if (answer.size() > 12) note(std::stoi(answer.substr(9, 3)));
}

/// Asks for what would take minutes and leaves.
void Traffic::leave(int number) {
  const std::string body = endless_scene();
  RawConnection connection(server_.port());
  connection.send(fmt::format(
      "POST /render?max_depth={} HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
      "Content-Length: {}\r\n\r\n{}",
      number, body.size(), body));
  connection.receives("HTTP/1.1 ", std::chrono::milliseconds(number % 200));
}

}  // namespace raytracer::test
