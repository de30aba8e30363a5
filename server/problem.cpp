#include "server/problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace raytracer {

int status_of(std::span<const Error> errors) {
  const auto any = [&](ErrorKind kind) {
    return std::any_of(errors.begin(), errors.end(),
                       [kind](const Error& error) { return error.kind == kind; });
  };
  if (any(ErrorKind::syntax)) return 400;
  return any(ErrorKind::invalid) ? 422 : 413;
}

Problem scene_problem(std::vector<Error> errors) {
  const int status = status_of(errors);
  std::string detail = errors.front().detail;
  if (status != 400 && errors.size() > 1) {
    const bool is_cut_off = errors.back().pointer.empty();  // by a last one that counts the rest
    detail = fmt::format("The scene has {} errors; the first, at {}: {}",
                         is_cut_off ? "many" : std::to_string(errors.size()),
                         errors.front().pointer, detail);
  } else if (status != 400) {
    const std::string& pointer = errors.front().pointer;
    detail = pointer.empty() ? "The document " + detail : fmt::format("{}: {}", pointer, detail);
  }
  return {status, std::move(detail), std::move(errors)};
}

Problem internal_error() { return {500, "The server failed on this request; its log says why"}; }

Problem client_closed_request() { return {499, "The client has left"}; }

std::string_view title_of(int status) {
  switch (status) {
    case 400:
      return "Bad Request";
    case 401:
      return "Unauthorized";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 406:
      return "Not Acceptable";
    case 408:
      return "Request Timeout";
    case 409:
      return "Conflict";
    case 411:
      return "Length Required";
    case 413:
      return "Content Too Large";
    case 414:
      return "URI Too Long";
    case 415:
      return "Unsupported Media Type";
    case 416:
      return "Range Not Satisfiable";
    case 422:
      return "Unprocessable Content";
    case 429:
      return "Too Many Requests";
    case 499:
      return "Client Closed Request";
    case 503:
      return "Service Unavailable";
    default:
      return "Internal Server Error";
  }
}

std::string to_json(const Problem& problem) {
  nlohmann::ordered_json json{{"type", "about:blank"},
                              {"title", title_of(problem.status)},
                              {"status", problem.status},
                              {"detail", problem.detail}};
  for (const Error& error : problem.errors)
    json["errors"].push_back({{"pointer", error.pointer}, {"detail", error.detail}});
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace raytracer
