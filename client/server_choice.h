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
  std::optional<std::string> token;
};

inline constexpr const char* what_a_token_has =
    "a token has printable ASCII characters without spaces only";

/// Whether HTTP takes it in a header.
bool is_token(const std::string& text);

/// With RAYTRACER_SERVER and RAYTRACER_TOKEN for what the command line does not say. Not read
/// before there is need of a server, so that what needs none works whatever they say. Throws
/// InputError for what is none.
ServerChoice with_variables(ServerChoice given);

}  // namespace raytracer::client
