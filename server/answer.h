// Writing answers into httplib's response, and ending connections that cannot go on.
#pragma once

#include <httplib.h>

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "server/problem.h"

namespace raytracer {

/// What becomes of the connection after the answer. `close` is for requests whose body, or rest,
/// is unread: it would be taken for the next request.
enum class ConnectionReuse { keep, close };

/// Replaces whatever the response held by the problem.
void answer_problem(httplib::Response& response, const Problem& problem,
                    ConnectionReuse afterwards);

/// 200 with these bytes.
void answer_bytes(httplib::Response& response, std::string bytes, std::string_view media_type);

/// The same for bytes that others use too: they are not copied.
void answer_shared_bytes(httplib::Response& response, std::shared_ptr<const std::string> bytes,
                         std::string_view media_type);

/// The status with this JSON, indented.
void answer_json(httplib::Response& response, int status, const nlohmann::ordered_json& json);

/// Whether this response ends its connection; see answer_problem.
bool closes_connection(const httplib::Response& response);

}  // namespace raytracer
