// Request bodies: judged by their header fields before a byte is read, then read with a limit and
// a deadline.
//
// httplib itself limits Content-Length only, unpacks compressed bodies without a limit and has
// timeouts per read; so only plain bodies of a known length come in here.
#pragma once

#include <cstdint>
#include <string>

#include "server/call.h"

namespace raytracer {

/// Whether the request says that something follows its header.
bool announces_body(const httplib::Request& request);

/// For requests that have no body. Throws HttpError 400 if there is one.
void require_no_body(const httplib::Request& request);

/// For requests whose body is a scene, unless the query names one. Throws HttpError: 411 without a
/// length or with a transfer coding, 400 for a length that is no number, 413 over `most_bytes`,
/// 415 for another type or coding, 400 for a body beside scene=.
void require_scene_body(const httplib::Request& request, std::int64_t most_bytes);

/// The Content-Length, 0 without one; the request was judged before.
std::int64_t body_length(const httplib::Request& request);

/// The whole body, of body_length(). Throws HttpError 408 if it is late: 30 s and 1 s for each
/// megabyte.
std::string read_body(Call& call, std::int64_t length);

}  // namespace raytracer
