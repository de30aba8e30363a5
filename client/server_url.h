// Where a daemon listens: http://HOST[:PORT].
#pragma once

#include <string>
#include <string_view>

namespace raytracer::client {

struct ServerUrl {
  bool tls = false;  ///< https
  std::string host;  ///< a name or an address, IPv6 without its brackets
  int port = 80;

  /// "http://127.0.0.1:8080", "http://[::1]:8080"
  std::string text() const;
};

/// Throws InputError that names `origin` ("--server") and says what a URL has to look like.
ServerUrl read_server_url(std::string_view text, std::string_view origin);

}  // namespace raytracer::client
