#include "server/token.h"

#include <openssl/crypto.h>

#include "server/etag.h"
#include "server/request_text.h"

namespace raytracer {

bool is_token(std::string_view text) {
  constexpr std::string_view allowed =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~+/=";
  return !text.empty() && text.find_first_not_of(allowed) == std::string_view::npos;
}

bool carries_token(std::string_view authorization, const std::string& token) {
  constexpr std::string_view scheme = "bearer ";
  if (lower_case(authorization.substr(0, scheme.size())) != scheme) return false;
  // Digests have one length, whatever was sent.
  const std::string given = sha256_hex(trimmed(authorization.substr(scheme.size())));
  const std::string expected = sha256_hex(token);
  return CRYPTO_memcmp(given.data(), expected.data(), expected.size()) == 0;
}

}  // namespace raytracer
