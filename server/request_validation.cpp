#include "server/request_validation.h"

#include <fmt/format.h>

#include "server/body.h"
#include "server/problem.h"
#include "server/token.h"

namespace raytracer {
namespace {

// httplib matches its catch-all patterns with std::regex, whose recursion overflows the stack at
// some thousands of characters.
constexpr std::size_t longest_target = 2048;

void require_short_target(const httplib::Request& request) {
  if (request.target.size() > longest_target)
    throw HttpError({414, fmt::format("The request's target has {} characters; at most {} are read",
                                      request.target.size(), longest_target)});
}

/// "Content-Length : 5" is a body to some and none to others, which smuggles requests through
/// proxies (RFC 9112, 5.1 wants this refused).
void require_plain_field_names(const httplib::Request& request) {
  for (const auto& [name, value] : request.headers)
    if (name.find_first_of(" \t") != std::string::npos)
      throw HttpError({400, "A header field's name contains white space"});
}

/// RFC 9112, 3.2: proxies would route by the one or by the other.
void require_one_host(const httplib::Request& request) {
  if (request.version == "HTTP/1.1" && request.get_header_value_count("Host") != 1)
    throw HttpError({400, "A request must have one Host field"});
}

void require_token(const httplib::Request& request, const std::string& token) {
  const bool is_open = request.path == "/healthz" || request.path == "/readyz";
  if (token.empty() || is_open) return;
  if (carries_token(request.get_header_value("Authorization"), token)) return;
  throw HttpError({401,
                   "This server wants a token: send Authorization: Bearer TOKEN",
                   {},
                   {{"WWW-Authenticate", "Bearer realm=\"raytracer\""}}});
}

}  // namespace

void validate_request(const httplib::Request& request, const RouteTable& routes,
                      const Config& config) {
  require_short_target(request);
  require_plain_field_names(request);
  require_one_host(request);
  require_token(request, config.token);
  const RouteTable::Match match = routes.match(request.method, request.path);
  if (match.route.body == RequestBody::none)
    require_no_body(request);
  else
    require_scene_body(request, config.limits.body);
}

}  // namespace raytracer
