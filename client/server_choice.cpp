#include "client/server_choice.h"

#include <fmt/format.h>

#include <regex>

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
    throw InputError(fmt::format(
        "--server or RAYTRACER_SERVER: '{}' is not the address of a server: http://HOST:PORT",
        text));
  return url;
}

}  // namespace raytracer::client
