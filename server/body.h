// Request bodies, read with a limit and a deadline.
//
// httplib itself limits Content-Length only, unpacks compressed bodies without a limit and has
// timeouts per read; so request_validation.h lets only plain bodies of a known length come in here.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/call.h"
#include "server/quota.h"

namespace raytracer {

/// Whether the request says that something follows its header.
bool announces_body(const httplib::Request& request);

/// The Content-Length; nothing without one. Throws HttpError 400 for several, or for what is no
/// number.
std::optional<std::int64_t> body_length(const httplib::Request& request);

/// The whole body, of body_length(); each byte that arrives is added to `memory`. Throws HttpError:
/// 408 if it is late, 30 s and 1 s for each megabyte; 429 if the memory for bodies is full.
std::string read_body(Call& call, std::int64_t length, Quota::Portion& memory);

}  // namespace raytracer
