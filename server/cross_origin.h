// Which pages of other origins may read answers: cross-origin resource sharing, as the WHATWG's
// fetch standard has it. An origin is where a page comes from: scheme, host and port.
#pragma once

#include <httplib.h>

#include <optional>
#include <string>
#include <vector>

namespace raytracer {

/// Origins as browsers write them, or "*" for all.
using AllowedOrigins = std::vector<std::string>;

/// The origin that the text means, or "*"; nothing if it means none.
std::optional<std::string> read_origin(const std::string& text);

/// Whether a browser asks what an allowed page may send. It sends no token with that.
bool is_preflight(const httplib::Request& request, const AllowedOrigins& allowed);

/// Everything that the service takes.
void answer_preflight(httplib::Response& response);

/// Has the browser give the answer to the page that asked, if that is allowed.
void add_cross_origin_fields(const httplib::Request& request, httplib::Response& response,
                             const AllowedOrigins& allowed);

}  // namespace raytracer
