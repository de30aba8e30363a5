// SHA-256: what names contents, and lets secrets be compared.
#pragma once

#include <string>
#include <string_view>

namespace raytracer {

/// SHA-256 in hexadecimal. Throws std::runtime_error if OpenSSL has no SHA-256.
std::string sha256_hex(std::string_view bytes);

}  // namespace raytracer
