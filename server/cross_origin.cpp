#include "server/cross_origin.h"

#include <algorithm>
#include <regex>

#include "server/request_text.h"

namespace raytracer {
namespace {

constexpr const char* every_origin = "*";

/// What Access-Control-Allow-Origin says to the page that asks; nothing if it is not allowed.
std::optional<std::string> allowed_origin(const httplib::Request& request,
                                          const AllowedOrigins& allowed) {
  for (const std::string& origin : {std::string(every_origin), request.get_header_value("Origin")})
    if (std::find(allowed.begin(), allowed.end(), origin) != allowed.end()) return origin;
  return {};
}

}  // namespace

std::optional<std::string> read_origin(const std::string& text) {
  if (text == every_origin) return text;
  static const std::regex form(
      R"(([a-z][a-z0-9+.-]*)://([a-z0-9.-]+|\[[0-9a-f:.]+\])(:[0-9]{1,5})?)");
  const std::string origin = lower_case(text);
  std::smatch part;
  if (!std::regex_match(origin, part, form)) return {};
  const bool is_usual_port =
      (part[1] == "http" && part[3] == ":80") || (part[1] == "https" && part[3] == ":443");
  return is_usual_port ? origin.substr(0, origin.rfind(':')) : origin;
}

bool is_preflight(const httplib::Request& request, const AllowedOrigins& allowed) {
  return request.method == "OPTIONS" && request.has_header("Origin") &&
         request.has_header("Access-Control-Request-Method") && allowed_origin(request, allowed);
}

void answer_preflight(httplib::Response& response) {
  response.status = 204;
  response.set_header("Access-Control-Allow-Methods", "GET, HEAD, POST, DELETE");
  response.set_header("Access-Control-Allow-Headers",
                      "Authorization, Cache-Control, Content-Type, If-None-Match, Scene-Digest, "
                      "X-Request-Id");
  response.set_header("Access-Control-Max-Age", "600");
}

void add_cross_origin_fields(const httplib::Request& request, httplib::Response& response,
                             const AllowedOrigins& allowed) {
  if (allowed.empty()) return;
  const std::optional<std::string> origin = allowed_origin(request, allowed);
  if (origin) {
    response.set_header("Access-Control-Allow-Origin", *origin);
    response.set_header(
        "Access-Control-Expose-Headers",
        "ETag, Location, Retry-After, Server-Timing, X-Request-Id, Render-Samples, "
        "Render-Light-Samples, "
        "Render-Error, Render-Precision, Render-Stop, Render-Tasks, Render-Workers");
  }
  if (origin == every_origin) return;
  const std::string varies_by = response.get_header_value("Vary");
  response.headers.erase("Vary");
  response.set_header("Vary", varies_by.empty() ? "Origin" : varies_by + ", Origin");
}

}  // namespace raytracer
