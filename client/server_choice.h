// Which server to talk to.
#pragma once

#include <optional>
#include <string>

namespace raytracer::client {

/// http://HOST[:PORT], or https.
struct ServerUrl {
  bool tls = false;
  std::string host;  ///< a name or an address, IPv6 without its brackets
  int port = 80;

  /// "http://127.0.0.1:8080", "http://[::1]:8080"
  std::string text() const;
};

/// Throws InputError that says what a URL has to look like.
ServerUrl read_server_url(const std::string& text);

struct ServerChoice {
  std::optional<ServerUrl> url;  ///< none: a private one
  std::string token;             ///< empty: none
};

}  // namespace raytracer::client
