// A small grammar by hand: the URL has no path, query or user, so a URL library would only have
// more to refuse.
#include "client/server_url.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "client/failure.h"

namespace raytracer::client {
namespace {

bool is_host(std::string_view host) {
  return !host.empty() && std::all_of(host.begin(), host.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '.' || c == '_';
  });
}

bool is_ipv6(std::string_view host) {
  return host.find(':') != host.npos &&
         host.find_first_not_of("0123456789abcdefABCDEF:.") == host.npos;
}

/// 0 for anything but 1 to 65535.
int read_port(std::string_view text) {
  int port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && port >= 1 && port <= 65535 ? port : 0;
}

}  // namespace

std::string ServerUrl::text() const {
  const bool ipv6 = host.find(':') != host.npos;
  return fmt::format("{}://{}{}{}:{}", tls ? "https" : "http", ipv6 ? "[" : "", host,
                     ipv6 ? "]" : "", port);
}

ServerUrl read_server_url(std::string_view text, std::string_view origin) {
  const auto refuse = [&](std::string_view reason) {
    return InputError(
        fmt::format("{}: '{}' {}; a server is written as http://HOST:PORT", origin, text, reason));
  };
  ServerUrl url;
  std::string_view rest = text;
  if (rest.starts_with("http://")) {
    rest.remove_prefix(7);
  } else if (rest.starts_with("https://")) {
    rest.remove_prefix(8);
    url.tls = true;
    url.port = 443;
  } else {
    throw refuse("does not begin with http://");
  }
  if (rest.ends_with('/')) rest.remove_suffix(1);
  if (rest.find_first_of("/?#@") != rest.npos) throw refuse("has more than a host and a port");

  if (rest.starts_with('[')) {
    const std::size_t close = rest.find(']');
    if (close == rest.npos || !is_ipv6(rest.substr(1, close - 1)))
      throw refuse("has no IPv6 address between its brackets");
    url.host = rest.substr(1, close - 1);
    rest.remove_prefix(close + 1);
  } else {
    url.host = rest.substr(0, rest.find(':'));
    if (!is_host(url.host)) throw refuse("has no host that could be looked up");
    rest.remove_prefix(url.host.size());
  }
  if (rest.empty()) return url;
  url.port = rest.starts_with(':') ? read_port(rest.substr(1)) : 0;
  if (url.port == 0) throw refuse("has no port from 1 to 65535 after its host");
  return url;
}

}  // namespace raytracer::client
