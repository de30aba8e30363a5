#include "server/listener.h"

#include <fmt/format.h>
#include <strings.h>
#include <sys/socket.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <span>
#include <string_view>
#include <thread>
#include <vector>

#include "server/answer.h"
#include "server/body.h"
#include "server/connection.h"
#include "server/cross_origin.h"
#include "server/problem.h"
#include "server/request_text.h"
#include "server/request_validation.h"
#include "server/thread_per_task.h"

namespace raytracer {
namespace {

using httplib::Request;
using httplib::Response;

// Nothing but this server's own files runs in the page; nobody else's page may frame it.
constexpr const char* content_security_policy =
    "default-src 'self'; img-src 'self' blob: data:; object-src 'none'; base-uri 'none'; "
    "form-action 'self'; frame-ancestors 'none'";

// httplib's handlers see a request as const, but the object is not.

/// RFC 9110 lets a server ignore Range, and httplib 0.11.4 would build every one of any number of
/// overlapping ranges in memory.
void ignore_ranges(const httplib::Request& request) {
  const_cast<httplib::Request&>(request).ranges.clear();
}

/// httplib compresses for whoever names a coding, also with the weight 0, which refuses it.
void drop_refused_codings(const Request& request) {
  constexpr const char* field = "Accept-Encoding";
  const std::string codings = header_list(request, field);
  std::string accepted;
  for (const std::string_view coding : parts_of(codings, ',')) {
    const std::vector<std::string_view> parts = parts_of(coding, ';');
    if (weight_of(std::span(parts).subspan(1)) == 0.0) continue;
    accepted.append(accepted.empty() ? "" : ", ").append(parts[0]);
  }
  httplib::Headers& headers = const_cast<Request&>(request).headers;
  headers.erase(field);
  if (!accepted.empty()) headers.emplace(field, accepted);
}

/// "/path" of "http://host/path", which every server must understand (RFC 9112, 3.2.2).
std::string without_authority(const std::string& target) {
  constexpr std::string_view scheme = "http://";
  if (strncasecmp(target.c_str(), scheme.data(), scheme.size()) != 0) return target;
  const std::size_t end = target.find_first_of("/?", scheme.size());
  if (end == std::string::npos || target[end] == '?') return "/";
  return target.substr(end);
}

void drop_authority(const httplib::Request& request) {
  if (without_authority(request.target) == request.target) return;
  std::string& path = const_cast<httplib::Request&>(request).path;
  path = without_authority(path);
}

/// RFC 9110, 5.6.2.
bool is_method_name(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
  });
}

ConnectionReuse after_refusal(const Call& call) {
  // Of several lengths, or of one that is oddly written, httplib shows the first at most: after a
  // refused POST nobody can be sure where the next request begins.
  const bool may_have_body = call.request.method == "POST" || announces_body(call.request);
  return may_have_body && !call.body_was_read ? ConnectionReuse::close : ConnectionReuse::keep;
}

std::string bracketed(const std::string& host) {
  return host.find(':') == std::string::npos ? host : fmt::format("[{}]", host);
}

}  // namespace

Listener::Listener(const Config& config, const RouteTable& routes, RequestLog& log,
                   Metrics& metrics)
    : config_(config), routes_(routes), log_(log), metrics_(metrics) {
  set_options();
  set_validation();
  set_dispatch();
  set_refusals();
  set_completion();
}

void Listener::set_options() {
  server_.new_task_queue = [] { return new ThreadPerTask(most_connections()); };
  // Without SO_REUSEPORT, httplib's default: a second server would share the port in silence.
  server_.set_socket_options([this](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    listening_socket_ = socket;
  });
  server_.set_tcp_nodelay(true);
  server_.set_keep_alive_max_count(1000);
  server_.set_keep_alive_timeout(2);  // an idle connection holds a thread, and shutdown up
  server_.set_read_timeout(5);
  server_.set_write_timeout(10);
  server_.set_payload_max_length(static_cast<std::size_t>(config_.limits.body));
  server_.set_default_headers({{"X-Content-Type-Options", "nosniff"},
                               {"Referrer-Policy", "no-referrer"},
                               {"Content-Security-Policy", content_security_policy}});
}

/// Before the body is asked for, and before it is read.
void Listener::set_validation() {
  using HandlerResponse = httplib::Server::HandlerResponse;
  server_.set_expect_100_continue_handler([this](const Request& request, Response& response) {
    return is_valid(request, response) ? 100 : response.status;
  });
  server_.set_pre_routing_handler([this](const Request& request, Response& response) {
    return is_valid(request, response) ? HandlerResponse::Unhandled : HandlerResponse::Handled;
  });
}

/// Validation has found the route already; these are the ways to get there with and without a body.
void Listener::set_dispatch() {
  const httplib::Server::Handler bodiless = [this](const Request& request, Response& response) {
    dispatch({request, response});
  };
  server_.Options("/.*", [](const Request&, Response& response) { answer_preflight(response); });
  server_.Options(R"(\*)", [this](const Request&, Response& response) {
    response.status = 204;
    response.set_header("Allow", routes_.methods());
  });
  server_.Get("/.*", bodiless);
  server_.Delete("/.*", bodiless);
  server_.Post("/.*", [this](const Request& request, Response& response,
                             const httplib::ContentReader& content) {
    dispatch({request, response, {}, &content});
  });
}

void Listener::set_refusals() {
  const httplib::Server::Handler unrouted = [this](const Request& request, Response& response) {
    answer_unrouted(request, response);
  };
  server_.set_error_handler(unrouted);
  server_.set_exception_handler([this](const Request& request, Response& response,
                                       std::exception_ptr) {  // NOLINT: httplib's signature
    log_.note("a request failed outside its handler");
    answer_problem(response, internal_error(), after_refusal({request, response}));
  });
}

void Listener::set_completion() {
  server_.set_post_routing_handler(
      [this](const Request& request, Response& response) { complete_fields(request, response); });
  server_.set_logger(
      [this](const Request& request, const Response& response) { finish(request, response); });
}

template <typename Step>
bool Listener::succeeds(Call& call, const Step& step) {
  const auto answer = [&](const Problem& problem) {
    if (problem.status == 413 || problem.status == 429 || problem.status == 503)
      metrics_.add("http_requests_refused_total", 1, {std::to_string(problem.status)});
    answer_problem(call.response, problem, after_refusal(call));
    return false;
  };
  try {
    step();
    return true;
  } catch (const HttpError& refusal) {
    return answer(refusal.problem());
  } catch (const std::exception& error) {
    log_.note(
        fmt::format("{} {} failed: {}", call.request.method, call.request.path, error.what()));
    return answer(internal_error());
  }
}

bool Listener::is_valid(const httplib::Request& request, httplib::Response& response) {
  Call call{request, response};
  return succeeds(call, [&] {
    log_.begin(request);
    ignore_ranges(request);
    drop_refused_codings(request);
    drop_authority(request);
    validate_request(request, routes_, config_);
  });
}

void Listener::dispatch(Call call) {
  succeeds(call, [&] {
    RouteTable::Match match = routes_.match(call.request.method, call.request.path);
    call.captured = std::move(match.captured);
    match.route.handler(call);
  });
}

/// What the fields of every answer are to say, whoever gave it.
void Listener::complete_fields(const httplib::Request& request, httplib::Response& response) {
  response.set_header("X-Request-Id", log_.begin(request));
  if (closes_connection(response)) {
    response.headers.erase("Keep-Alive");
    response.headers.erase("Connection");  // httplib adds its own to this server's
    response.set_header("Connection", "close");
  }
  // httplib says "Content-Length: 0" where HTTP wants the length of the GET's body or nothing.
  const bool has_no_length = response.status == 204 || response.status == 304 ||
                             (request.method == "HEAD" && response.status == 200 &&
                              response.get_header_value("Content-Length") == "0");
  if (has_no_length) response.headers.erase("Content-Length");
  response.headers.erase("Accept-Ranges");
  // What a handler says nothing about is true for a moment.
  if (!response.has_header("Cache-Control")) response.set_header("Cache-Control", "no-store");
  // Texts are compressed for those who accept it; images, which are not, vary by Accept.
  const bool is_of_body = response.status == 200 || response.status == 304;
  if (is_of_body && !response.has_header("Vary")) response.set_header("Vary", "Accept-Encoding");
  add_cross_origin_fields(request, response, config_.allowed_origins);
}

/// Answers of httplib's own, before any handler: a request that it could not read. Where the next
/// one would begin is unknown then.
void Listener::answer_unrouted(const httplib::Request& request, httplib::Response& response) {
  if (response.has_header("Content-Type")) return;
  const int status = response.status;
  // A Range that httplib cannot read may be ignored as any other; the body of a POST could not be
  // read here, and OPTIONS has no route.
  const bool is_routed =
      request.method == "GET" || request.method == "HEAD" || request.method == "DELETE";
  if (status == 416 && is_routed) {
    response.status = -1;  // as before any handler
    if (is_valid(request, response)) dispatch({request, response});
    return;
  }
  ignore_ranges(request);
  // Of a method that httplib does not know it has read the first line alone, and so no token.
  if (status == 400 && is_method_name(request.method) && request.version == "HTTP/1.1" &&
      config_.token.empty()) {
    try {
      const std::string target = without_authority(request.target);
      routes_.match(request.method, target.substr(0, target.find('?')));
    } catch (const HttpError& refusal) {
      return answer_problem(response, refusal.problem(), ConnectionReuse::close);
    }
  }
  const std::string detail =
      status == 414   ? "The request's target is too long"
      : status == 416 ? "The Range field cannot be read; leave it out"
      : status < 500  ? fmt::format(
                            "This is not a request that HTTP/1.1 knows, or a header field "
                             "is longer than {} bytes",
                            CPPHTTPLIB_HEADER_MAX_LENGTH)
                     : "The server has too many connections";
  answer_problem(response, {status, detail}, ConnectionReuse::close);
}

void Listener::finish(const httplib::Request& request, const httplib::Response& response) {
  // httplib does not expect exceptions from its logger.
  try {
    const double took_s = log_.end(request, response);
    const Route* const route = routes_.find(request.method, request.path);
    const std::string method = route ? route->method : "other";
    const std::string pattern = route ? route->pattern : "none";
    metrics_.add("http_requests_total", 1, {method, pattern, std::to_string(response.status)});
    metrics_.observe("http_request_duration_seconds", took_s, {method, pattern});
    if (closes_connection(response)) linger(find_socket(request));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "raytracer-server: no line for a request: %s\n", error.what());
  }
}

std::string Listener::bind() {
  errno = 0;
  const bool any_port = config_.port == 0;
  if (any_port)
    port_ = server_.bind_to_any_port(config_.host);
  else
    port_ = server_.bind_to_port(config_.host, config_.port) ? config_.port : -1;
  if (const int error = errno; port_ < 0)
    throw ConfigError(
        fmt::format("cannot listen on {}:{} ({}): choose another --host (RAYTRACER_HOST) or --port "
                    "(RAYTRACER_PORT); 0 takes a free port",
                    bracketed(config_.host), config_.port,
                    error == 0 ? "the name is not known" : std::strerror(error)));
  // httplib's backlog of 5 lets a burst of connections wait a second for TCP to try again.
  ::listen(listening_socket_, 511);
  return fmt::format("http://{}:{}", bracketed(config_.host), port_);
}

bool Listener::run() {
  struct AtEnd {
    std::atomic<bool>& has_ended;
    ~AtEnd() { has_ended = true; }
  } const at_end{has_ended_};  // whatever ends it
  return server_.listen_after_bind() && stopping_;
}

void Listener::stop() {
  stopping_ = true;
  // httplib ignores a stop() that comes before it listens; it may have failed meanwhile.
  while (!server_.is_running() && !has_ended_)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  server_.stop();
  // Otherwise a client that says nothing, or says it slowly, keeps its thread and run() waiting.
  shut_down_connections(port_);
}

}  // namespace raytracer
