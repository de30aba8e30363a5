// The bearer token (RFC 6750) that every request must carry if one was configured.
#pragma once

#include <string>
#include <string_view>

namespace raytracer {

/// Whether the text can travel in an Authorization field: RFC 6750's b64token.
bool is_token(std::string_view text);

/// Whether an Authorization field carries `token`. The time that this takes says nothing about
/// where they differ, nor about the token's length.
bool carries_token(std::string_view authorization, const std::string& token);

}  // namespace raytracer
