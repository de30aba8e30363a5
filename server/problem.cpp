#include "server/problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

namespace raytracer {
namespace {

/// HTTP's own phrase for a status.
std::string_view title_of(int status) {
  static constexpr std::array<std::pair<int, std::string_view>, 16> titles{{
      {400, "Bad Request"},
      {401, "Unauthorized"},
      {404, "Not Found"},
      {405, "Method Not Allowed"},
      {406, "Not Acceptable"},
      {408, "Request Timeout"},
      {409, "Conflict"},
      {411, "Length Required"},
      {413, "Content Too Large"},
      {414, "URI Too Long"},
      {415, "Unsupported Media Type"},
      {416, "Range Not Satisfiable"},
      {422, "Unprocessable Content"},
      {429, "Too Many Requests"},
      {499, "Client Closed Request"},
      {503, "Service Unavailable"},
  }};
  for (const auto& [code, title] : titles)
    if (code == status) return title;
  return "Internal Server Error";
}

nlohmann::ordered_json to_json(const Error& error) {
  nlohmann::ordered_json json{{"pointer", error.pointer}, {"detail", error.detail}};
  if (error.is_about_key) json["about"] = "key";
  if (!error.syntax) return json;
  json["line"] = error.syntax->line;
  json["column"] = error.syntax->column;
  json["reason"] = error.syntax->reason;
  return json;
}

}  // namespace

void refuse(int status, std::string detail,
            std::vector<std::pair<std::string, std::string>> headers) {
  throw HttpError({status, std::move(detail), {}, std::move(headers)});
}

Problem scene_problem(std::vector<Error> errors) {
  const auto any = [&](ErrorKind kind) {
    return std::any_of(errors.begin(), errors.end(),
                       [kind](const Error& error) { return error.kind == kind; });
  };
  const int status = any(ErrorKind::syntax) ? 400 : any(ErrorKind::invalid) ? 422 : 413;
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

std::string to_json(const Problem& problem) {
  nlohmann::ordered_json json{{"type", "about:blank"},
                              {"title", title_of(problem.status)},
                              {"status", problem.status},
                              {"detail", problem.detail}};
  for (const Error& error : problem.errors) json["errors"].push_back(to_json(error));
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace raytracer
