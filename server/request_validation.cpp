#include "server/request_validation.h"

#include <fmt/format.h>
#include <openssl/crypto.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "server/body.h"
#include "server/cross_origin.h"
#include "server/digest.h"
#include "server/problem.h"
#include "server/request_text.h"

namespace raytracer {
namespace {

// httplib matches its catch-all patterns with std::regex, whose recursion overflows the stack at
// some thousands of characters.
constexpr std::size_t longest_target = 2048;

void require_short_target(const httplib::Request& request) {
  if (request.target.size() > longest_target)
    refuse(414, fmt::format("The request's target has {} characters; at most {} are read",
                            request.target.size(), longest_target));
}

/// httplib drops what is given twice alike, and of "a=b=c" takes the first name and the last value.
void require_plain_query(const httplib::Request& request) {
  const std::string_view target = request.target;
  const std::size_t begin = std::min(target.find('?'), target.size() - 1) + 1;
  std::set<std::string_view> names;
  for (std::size_t at = begin; at < target.size();) {
    const std::size_t end = std::min(target.find('&', at), target.size());
    const std::string_view parameter = target.substr(at, end - at);
    const std::size_t sign = parameter.find('=');
    if (parameter.find('=', sign + 1) != parameter.npos && sign != parameter.npos)
      refuse(400, fmt::format("The query parameter \"{}\" has more than one \"=\"", parameter));
    if (!parameter.empty() && !names.insert(parameter.substr(0, sign)).second)
      refuse(400, fmt::format("The query parameter \"{}\" is given more than once",
                              parameter.substr(0, sign)));
    at = end + 1;
  }
}

/// "Content-Length : 5" is a body to some and none to others, which smuggles requests through
/// proxies (RFC 9112, 5.1 wants this refused).
void require_plain_field_names(const httplib::Request& request) {
  for (const auto& [name, value] : request.headers)
    if (name.find_first_of(" \t") != std::string::npos)
      refuse(400, "A header field's name contains white space");
}

/// RFC 9112, 3.2: proxies would route by the one or by the other.
void require_one_host(const httplib::Request& request) {
  if (request.version == "HTTP/1.1" && request.get_header_value_count("Host") != 1)
    refuse(400, "A request must have one Host field");
}

/// Whether an Authorization field carries the bearer token (RFC 6750). The time that this takes
/// says nothing about where they differ, nor about the token's length: digests have one length.
bool carries_token(std::string_view authorization, const std::string& token) {
  constexpr std::string_view scheme = "bearer ";
  if (lower_case(authorization.substr(0, scheme.size())) != scheme) return false;
  const std::string given = sha256_hex(trimmed(authorization.substr(scheme.size())));
  const std::string expected = sha256_hex(token);
  return CRYPTO_memcmp(given.data(), expected.data(), expected.size()) == 0;
}

void require_token(const httplib::Request& request, const std::string& token) {
  const std::string authorization = request.get_header_value("Authorization");
  if (token.empty() || carries_token(authorization, token)) return;
  refuse(401,
         authorization.empty() ? "This server wants a token: send Authorization: Bearer TOKEN"
                               : "This Authorization does not carry the server's token",
         {{"WWW-Authenticate", "Bearer realm=\"raytracer\""}});
}

bool is_json(const httplib::Request& request) {
  const std::string type = request.get_header_value("Content-Type");
  return lower_case(trimmed(std::string_view(type).substr(0, type.find(';')))) ==
         "application/json";
}

/// For requests that have no body.
void require_no_body(const httplib::Request& request) {
  if (announces_body(request))
    refuse(400, fmt::format("{} takes no body here; send it without one", request.method));
}

/// What the server can do as a whole (RFC 9110, 9.3.7).
bool asks_for_server_options(const httplib::Request& request) {
  return request.method == "OPTIONS" && request.path == "*";
}

/// For requests whose body is a scene, unless the query names one.
void require_scene_body(const httplib::Request& request, std::int64_t most_bytes) {
  if (request.has_header("Transfer-Encoding"))
    refuse(411, "Bodies must come with a Content-Length, not with Transfer-Encoding");
  const std::string coding = header_list(request, "Content-Encoding");
  if (!coding.empty() && lower_case(coding) != "identity")
    refuse(415, fmt::format("Content-Encoding \"{}\" is not supported; send the scene as it is",
                            coding));
  const std::optional<std::int64_t> length = body_length(request);
  if (request.has_param("scene")) {
    if (length.value_or(0) > 0)
      refuse(400, "The query names a scene and the body is one: send one of them only");
    return;
  }
  if (!length) refuse(411, "Content-Length is missing: send a scene as the body, or name ?scene=");
  if (*length > most_bytes)
    refuse(413, fmt::format("The body has {} bytes, but this server accepts {} ({})", *length,
                            most_bytes, row_of(&Limits::body).flag));
  if (!is_json(request))
    refuse(415,
           "The body must be a scene with Content-Type: application/json "
           "(curl: -H 'Content-Type: application/json')");
}

}  // namespace

void validate_request(const httplib::Request& request, const RouteTable& routes,
                      const Config& config) {
  require_short_target(request);
  require_plain_query(request);
  require_plain_field_names(request);
  require_one_host(request);
  if (is_preflight(request, config.allowed_origins)) return require_no_body(request);
  const Route* const route = routes.find(request.method, request.path);
  if (!route || !route->is_public) require_token(request, config.token);
  if (asks_for_server_options(request)) return require_no_body(request);
  const RouteTable::Match match = routes.match(request.method, request.path);
  if (match.route.body == RequestBody::none)
    require_no_body(request);
  else
    require_scene_body(request, config.limits.body);
}

}  // namespace raytracer
