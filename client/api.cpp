// The one file with httplib, and with the service's JSON but for plans and curves, which it passes
// on. Renders are jobs, so every request is answered soon: a server that is gone is noticed within
// the timeout, however long a render takes.
#include "client/api.h"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "client/failure.h"
#include "client/scene_errors.h"

namespace raytracer::client {
namespace {

using nlohmann::json;

httplib::Client make_client(const ServerUrl& url, const std::string& token, time_t answer_limit_s) {
#ifndef CPPHTTPLIB_OPENSSL_SUPPORT
  if (url.tls) throw InputError(url.text() + ": this raytracer was built without https");
#endif
  auto client = url.tls ? httplib::Client(url.text()) : httplib::Client(url.host, url.port);
  if (!token.empty()) client.set_bearer_token_auth(token);
  client.set_keep_alive(true);
  client.set_tcp_nodelay(true);
  client.set_connection_timeout(5);
  client.set_read_timeout(answer_limit_s);
  client.set_write_timeout(answer_limit_s);
  return client;
}

/// "/jobs" with the overrides as its query.
std::string with_query(const std::string& path, const Overrides& overrides) {
  if (overrides.empty()) return path;
  return httplib::append_query_params(path, httplib::Params(overrides.begin(), overrides.end()));
}

std::string text_of(const json& object, const char* key) {
  if (!object.is_object()) return {};
  const auto value = object.find(key);
  return value != object.end() && value->is_string() ? value->get<std::string>() : std::string();
}

}  // namespace

struct Api::Connection {
  ServerUrl url;
  std::string token;
  Interrupts& interrupts;
  httplib::Client client;
  bool is_silent = false;  ///< it did not answer when a job was to be deleted

  httplib::Response get(const std::string& path, const httplib::Headers& headers = {}) {
    interrupts.check();
    const httplib::Result result = client.Get(path, headers);
    interrupts.check();
    return expect(200, "GET " + path, result);
  }

  /// The body of what may not be there.
  std::optional<std::string> find(const std::string& path) {
    interrupts.check();
    const httplib::Result result = client.Get(path);
    interrupts.check();
    if (result && result->status == 404) return std::nullopt;
    return expect(200, "GET " + path, result).body;
  }

  httplib::Response post(const std::string& path, const SceneText& scene, const Overrides& query,
                         int expected_status, const httplib::Headers& headers = {}) {
    interrupts.check();
    const std::string target = with_query(path, query);
    // In pieces: httplib would copy a body.
    const auto write = [&](std::size_t begin, std::size_t count, httplib::DataSink& sink) {
      return sink.write(scene.text.data() + begin, count);
    };
    const httplib::Result result =
        query.contains("scene")
            ? client.Post(target, headers)
            : client.Post(target, headers, scene.text.size(), write, "application/json");
    interrupts.check();
    if (result.error() == httplib::Error::Write)
      throw ServerError(fmt::format(
          "{}: the server closed the connection before it had the whole scene ({} bytes): its "
          "--max-body may be less",
          url.text(), scene.text.size()));
    if (result && (result->status == 400 || result->status == 413 || result->status == 422))
      throw InputError(explain(result->body, scene, query));
    return expect(expected_status, "POST " + path, result);
  }

  /// The answer to `request`, "GET /scenes", if it has this status.
  httplib::Response expect(int status, const std::string& request,
                           const httplib::Result& result) const {
    const std::string server = url.text();
    if (result.error() == httplib::Error::Connection)
      throw ServerError(fmt::format(
          "{}: nothing answers there: start a raytracer-server, name another with --server or "
          "RAYTRACER_SERVER, or name none to have a private one",
          server));
    if (result.error() == httplib::Error::SSLConnection)
      throw ServerError(server + ": no TLS connection: does the server speak https there?");
    if (!result)
      throw ServerError(fmt::format("{}: {} got no answer ({} error): the server may have ended",
                                    server, request, httplib::to_string(result.error())));
    if (result->status == status) return *result;

    const std::string detail = text_of(json::parse(result->body, nullptr, false), "detail");
    if (result->status == 401)
      throw InputError(fmt::format("{}: wants {} token: give --token or RAYTRACER_TOKEN", server,
                                   token.empty() ? "a" : "another"));
    if (result->status == 406)
      throw InputError("--output: another kind of file is needed. " + detail);
    if (result->has_header("Retry-After")) {
      const std::string after = result->get_header_value("Retry-After");
      throw ServerBusy(fmt::format("{}: {}; try again in {} s", server, detail, after),
                       std::chrono::seconds(std::atoi(after.c_str())));  // 0 if it is a date
    }
    const std::string what =
        fmt::format("{}: {} was answered with status {}: {}", server, request, result->status,
                    detail.empty() ? "is it a raytracer-server?" : detail);
    if (result->status == 404) throw NotFound(what);
    throw ServerError(what);
  }

  /// The body, a JSON object that has this key.
  json parse(const httplib::Response& response, const char* key) const {
    json value = json::parse(response.body, nullptr, false);
    if (!value.is_object() || !value.contains(key))
      throw ServerError(
          fmt::format("{}: the answer has no \"{}\": is it a raytracer-server?", url.text(), key));
    return value;
  }

  Job read_job(const httplib::Response& response) const {
    const json value = parse(response, "status");
    return {text_of(value, "id"), text_of(value, "status"), value.value("progress", 0.0),
            text_of(value, "detail")};
  }
};

Api::Api(const ServerUrl& url, const std::string& token, Interrupts& interrupts)
    : connection_(new Connection{url, token, interrupts, make_client(url, token, 60)}) {
  interrupts.on_signal([this] { connection_->client.stop(); });
}

Api::~Api() { connection_->interrupts.on_signal(nullptr); }

std::string Api::url() const { return connection_->url.text(); }

std::vector<ShippedScene> Api::scenes() {
  const json list = connection_->parse(connection_->get("/scenes"), "scenes");
  std::vector<ShippedScene> scenes;
  for (const json& entry : list.at("scenes"))
    scenes.push_back({text_of(entry, "name"), text_of(entry, "description")});
  return scenes;
}

SceneText Api::shipped_scene(const std::string& name) {
  // Not looked for in the list: the server has to read all scenes to write it.
  const bool may_be_one = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
  if (may_be_one && !name.empty())
    if (auto scene = connection_->find("/scenes/" + name)) return {name, std::move(*scene), false};
  std::string known;
  for (const ShippedScene& scene : scenes()) known += (known.empty() ? "" : ", ") + scene.name;
  throw InputError(fmt::format(
      "{}: there is no such file, and no shipped scene of that name; there are: {}", name, known));
}

Cluster Api::cluster() {
  const httplib::Response response = connection_->get("/cluster");
  const json answer = connection_->parse(response, "workers");
  try {
    const json& tasks = answer.at("tasks");
    Cluster cluster{{}, tasks.at("waiting"), tasks.at("running"), answer.at("redelivered")};
    for (const bool works : {true, false})
      for (const json& member : answer.at(works ? "workers" : "fronts"))
        cluster.members.push_back({member.at("name"), member.at("build"),
                                   member.at("instruction_set"), member.at("threads"),
                                   member.at("tasks_done"), member.at("last_heard_s"), works});
    return cluster;
  } catch (const json::exception& error) {
    throw ServerError(fmt::format("{}: the answer to GET /cluster cannot be read: {}",
                                  connection_->url.text(), error.what()));
  }
}

void Api::validate(const SceneText& scene) {
  // Whatever image the server has for this scene, the client wants no other: it need not render.
  // The connection is closed because httplib 0.11 would wait for the body, which a 304 has not.
  connection_->post("/render", scene, {}, 304, {{"If-None-Match", "*"}, {"Connection", "close"}});
}

std::string Api::plan(const SceneText& scene, const Overrides& overrides) {
  const httplib::Response response = connection_->post("/plan", scene, overrides, 200);
  connection_->parse(response, "features");
  return response.body;
}

std::string Api::keep_scene(const SceneText& scene) {
  const httplib::Response response = connection_->post("/scenes", scene, {}, 201);
  return text_of(connection_->parse(response, "id"), "id");
}

Job Api::start_job(const SceneText& scene, const Overrides& query, std::string_view media_type) {
  httplib::Headers headers;
  if (!media_type.empty())
    headers.emplace("Accept", fmt::format("{}, application/json", media_type));
  return connection_->read_job(connection_->post("/jobs", scene, query, 202, headers));
}

Job Api::job(const std::string& id) {
  return connection_->read_job(connection_->get("/jobs/" + id));
}

RenderedImage Api::job_image(const std::string& id, std::string_view media_type) {
  httplib::Response response =
      connection_->get("/jobs/" + id + "/image", {{"Accept", std::string(media_type)}});
  return {std::move(response.body),
          response.get_header_value("Render-Samples"),
          response.get_header_value("Render-Error"),
          response.get_header_value("Render-Precision"),
          response.get_header_value("Render-Stop"),
          response.get_header_value("Server-Timing")};
}

std::string Api::job_result(const std::string& id) {
  return connection_->get("/jobs/" + id + "/result").body;
}

void Api::pause(std::chrono::microseconds duration) { connection_->interrupts.sleep(duration); }

void Api::delete_job(const std::string& id) noexcept {
  try {
    // The other client may have been cut short. Of many jobs only one waits for a dead server.
    if (connection_->is_silent) return;
    connection_->is_silent =
        !make_client(connection_->url, connection_->token, 2).Delete("/jobs/" + id);
  } catch (...) {
    // Nobody is left to tell: what the caller reports instead matters more.
  }
}

}  // namespace raytracer::client
