#include "client/server_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "client/environment.h"
#include "client/failure.h"

namespace raytracer::client {

std::string ServerUrl::text() const {
  const bool ipv6 = host.find(':') != host.npos;
  return fmt::format("{}://{}{}{}:{}", tls ? "https" : "http", ipv6 ? "[" : "", host,
                     ipv6 ? "]" : "", port);
}

ServerUrl read_server_url(const std::string& text) {
  static const std::regex form(
      R"(http(s?)://(?:([A-Za-z0-9._-]+)|\[([0-9A-Fa-f.]*:[0-9A-Fa-f:.]*)\])(?::(\d{1,5}))?/?)");
  std::smatch parts;
  const bool matches = std::regex_match(text, parts, form);
  ServerUrl url;
  if (matches) {
    url.tls = parts.length(1) > 0;
    url.host = parts.str(2) + parts.str(3);
    url.port = parts.length(4) > 0 ? std::stoi(parts.str(4)) : url.tls ? 443 : 80;
  }
  if (!matches || url.port < 1 || url.port > 65535)
    throw InputError(
        fmt::format("--server or RAYTRACER_SERVER: '{}' is not the address of a server: write "
                    "http://HOST:PORT or https://HOST",
                    text));
  return url;
}

bool is_token(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c <= '~'; });
}

ServerChoice with_variables(ServerChoice given) {
  const std::string server = variable("RAYTRACER_SERVER");
  if (!given.url && !server.empty()) given.url = read_server_url(server);
  const std::string token = variable("RAYTRACER_TOKEN");
  if (!given.token && !is_token(token))
    throw InputError(fmt::format("RAYTRACER_TOKEN: {}", what_a_token_has));
  if (!given.token && !token.empty()) given.token = token;
  return given;
}

}  // namespace raytracer::client
