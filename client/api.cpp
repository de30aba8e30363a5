// The one file with httplib, and with the service's JSON but for plans and curves, which it passes
// on. Renders are jobs, so every request is answered soon: a server that is gone is noticed within
// the timeout, however long a render takes.
#include "client/api.h"

#include <fmt/format.h>
#include <httplib.h>

#include <nlohmann/json.hpp>
#include <utility>

namespace raytracer::client {
namespace {

using nlohmann::json;

constexpr time_t connect_limit_s = 5;
constexpr time_t answer_limit_s = 60;

httplib::Client make_client(const ServerUrl& url) {
  if (!url.tls) return httplib::Client(url.host, url.port);
#ifdef CPPHTTPLIB_OPENSSL_SUPPORT
  return httplib::Client(url.text());
#else
  throw InputError(url.text() + ": this raytracer was built without https");
#endif
}

std::string text_of(const json& object, const char* key) {
  if (!object.is_object()) return {};
  const auto value = object.find(key);
  return value != object.end() && value->is_string() ? value->get<std::string>() : std::string();
}

/// A problem document's `detail`, or its `title`; a question where the answer is none.
std::string problem_text(const json& problem) {
  std::string detail = text_of(problem, "detail");
  std::string title = text_of(problem, "title");
  if (!detail.empty()) return detail;
  return title.empty() ? "is it a raytracer-server?" : title;
}

std::vector<SceneError> scene_errors(const json& problem) {
  std::vector<SceneError> errors;
  if (!problem.is_object() || !problem.contains("errors")) return errors;
  for (const json& error : problem.at("errors"))
    errors.push_back({text_of(error, "pointer"), text_of(error, "detail")});
  return errors;
}

bool is_plain_id(const std::string& id) {
  return !id.empty() && id.find_first_not_of(
                            "0123456789abcdefghijklmnopqrstuvwxyz"
                            "ABCDEFGHIJKLMNOPQRSTUVWXYZ-_.~") == id.npos;
}

}  // namespace

struct Api::Connection {
  ServerUrl url;
  std::string token;
  Interrupts& interrupts;
  httplib::Client client;

  Connection(const ServerUrl& server, std::string bearer, Interrupts& signals)
      : url(server), token(std::move(bearer)), interrupts(signals), client(make_client(server)) {
    configure(client, answer_limit_s);
  }

  static void configure(httplib::Client& client, time_t limit_s) {
    client.set_keep_alive(true);
    client.set_tcp_nodelay(true);
    client.set_connection_timeout(connect_limit_s);
    client.set_read_timeout(limit_s);
    client.set_write_timeout(limit_s);
  }

  httplib::Request request(const char* method, const std::string& path,
                           const httplib::Headers& headers = {}) const {
    httplib::Request made;
    made.method = method;
    made.path = path;
    made.headers = headers;
    if (!token.empty()) made.headers.emplace("Authorization", "Bearer " + token);
    return made;
  }

  httplib::Request post(const std::string& path, const std::string& scene_text,
                        httplib::Headers headers = {}) const {
    headers.emplace("Content-Type", "application/json");
    httplib::Request made = request("POST", path, headers);
    made.body = scene_text;
    return made;
  }

  /// The answer, if it has the status that is expected.
  httplib::Response send(const httplib::Request& request, int expected) {
    interrupts.check();
    const httplib::Result result = client.send(request);
    interrupts.check();
    if (!result) throw unreachable(request, result.error());
    if (result->status == expected) return *result;
    refuse(request, *result);
  }

  httplib::Response get(const std::string& path, const httplib::Headers& headers = {}) {
    return send(request("GET", path, headers), 200);
  }

  ServerError unreachable(const httplib::Request& request, httplib::Error error) const {
    if (error == httplib::Error::Connection)
      return ServerError(fmt::format(
          "{}: nothing answers there: start a raytracer-server, name another with --server or "
          "RAYTRACER_SERVER, or name none to have a private one",
          url.text()));
    if (error == httplib::Error::SSLConnection)
      return ServerError(url.text() + ": no TLS connection: does the server speak https there?");
    if (error == httplib::Error::Write && !request.body.empty())
      return ServerError(fmt::format(
          "{}: the server closed the connection before it had the whole scene ({} bytes): its "
          "--max-body may be less",
          url.text(), request.body.size()));
    return ServerError(fmt::format("{}: {} {} got no answer ({} error): the server may have ended",
                                   url.text(), request.method, request.path,
                                   httplib::to_string(error)));
  }

  [[noreturn]] void refuse(const httplib::Request& request,
                           const httplib::Response& response) const {
    const json problem = json::parse(response.body, nullptr, false);
    const std::string detail = problem_text(problem);
    switch (response.status) {
      case 400:
      case 413:
      case 422:
        throw Refused(detail, scene_errors(problem));
      case 401:
        throw InputError(
            fmt::format("{}: {}: give --token or RAYTRACER_TOKEN", url.text(), detail));
      case 429:
      case 503:
        throw ServerError(fmt::format(
            "{}: {}{}", url.text(), detail,
            response.has_header("Retry-After")
                ? fmt::format("; try again in {} s", response.get_header_value("Retry-After"))
                : ""));
      default:
        throw ServerError(fmt::format("{}: {} {} was answered with status {}: {}", url.text(),
                                      request.method, request.path, response.status, detail));
    }
  }

  /// The body as JSON; `what` names it in the error.
  json parse(const httplib::Response& response, const char* what) const {
    json value = json::parse(response.body, nullptr, false);
    if (value.is_discarded())
      throw ServerError(
          fmt::format("{}: the answer is no {}: is it a raytracer-server?", url.text(), what));
    return value;
  }

  /// "/jobs" with the overrides as its query.
  static std::string with_query(const std::string& path, const Overrides& overrides) {
    if (overrides.empty()) return path;
    return httplib::append_query_params(path, httplib::Params(overrides.begin(), overrides.end()));
  }

  Job read_job(const httplib::Response& response) const {
    const json value = parse(response, "job");
    Job job;
    job.id = text_of(value, "id");
    job.status = text_of(value, "status");
    if (value.is_object()) job.progress = value.value("progress", 0.0);
    if (!is_plain_id(job.id) || job.status.empty())
      throw ServerError(url.text() + ": the answer is no job: is it a raytracer-server?");
    job.detail = text_of(value, "detail");
    return job;
  }
};

Api::Api(const ServerUrl& url, const std::string& token, Interrupts& interrupts)
    : connection_(std::make_unique<Connection>(url, token, interrupts)) {
  interrupts.on_signal([this] { connection_->client.stop(); });
}

Api::~Api() { connection_->interrupts.on_signal(nullptr); }

std::vector<ShippedScene> Api::scenes() {
  const json list = connection_->parse(connection_->get("/scenes"), "list of scenes");
  const json& entries = list.is_object() && list.contains("scenes") ? list.at("scenes") : list;
  std::vector<ShippedScene> scenes;
  for (const json& entry : entries)
    scenes.push_back({text_of(entry, "name"), text_of(entry, "description")});
  return scenes;
}

std::string Api::scene_document(const std::string& name) {
  return connection_->get("/scenes/" + name).body;
}

void Api::validate(const std::string& scene_text) {
  // Whatever image the server has for this scene, the client wants no other: it need not render.
  httplib::Request request = connection_->post("/render", scene_text, {{"If-None-Match", "*"}});
  // A 304 has no body, but httplib 0.11 waits for one unless a Content-Length says 0.
  bool valid = false;
  request.response_handler = [&valid](const httplib::Response& response) {
    valid = response.status == 304;
    return !valid;
  };
  try {
    connection_->send(request, 304);
  } catch (const ServerError&) {
    if (!valid) throw;
  }
}

std::string Api::plan(const std::string& scene_text, const Overrides& overrides) {
  const std::string path = Connection::with_query("/plan", overrides);
  const httplib::Response response = connection_->send(connection_->post(path, scene_text), 200);
  connection_->parse(response, "plan");
  return response.body;
}

Job Api::start_job(const std::string& scene_text, const Overrides& query) {
  const std::string path = Connection::with_query("/jobs", query);
  return connection_->read_job(connection_->send(connection_->post(path, scene_text), 202));
}

Job Api::job(const std::string& id) {
  return connection_->read_job(connection_->get("/jobs/" + id));
}

RenderedImage Api::job_image(const std::string& id, ImageFormat format) {
  httplib::Response response =
      connection_->get("/jobs/" + id + "/image", {{"Accept", std::string(media_type(format))}});
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

void Api::pause(std::chrono::milliseconds duration) { connection_->interrupts.sleep(duration); }

void Api::delete_job(const std::string& id) noexcept {
  try {
    httplib::Client fresh = make_client(connection_->url);  // the other may have been cut short
    Connection::configure(fresh, 2);
    fresh.send(connection_->request("DELETE", "/jobs/" + id));
  } catch (...) {
    // Nobody is left to tell: what the caller reports instead matters more.
  }
}

}  // namespace raytracer::client
