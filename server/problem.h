// What a client is told when it does not get what it asked for: RFC 9457, and the one place where
// the engine's errors become an HTTP status.
#pragma once

#include <exception>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/engine.h"

namespace raytracer {

/// An answer that is an error. `detail` is for a person and says what to do.
struct Problem {
  int status = 500;
  std::string detail;
  std::vector<Error> errors{};  ///< of a scene document; empty otherwise
  std::vector<std::pair<std::string, std::string>> headers{};  ///< Allow, Retry-After and the like
};

/// Ends a request from wherever the reason is found; the dispatcher turns it into the answer.
class HttpError : public std::exception {
 public:
  explicit HttpError(Problem problem) : problem_(std::move(problem)) {}
  const Problem& problem() const noexcept { return problem_; }
  const char* what() const noexcept override { return problem_.detail.c_str(); }

 private:
  Problem problem_;
};

/// The status for a non-empty list of a scene's errors: not JSON 400, against the rules 422, and
/// only if nothing but limits is exceeded 413.
int status_of(std::span<const Error> errors);

/// The answer to a document with these errors, all of them.
Problem scene_problem(std::vector<Error> errors);

/// 500: what is wrong is the server's business, and in its log.
Problem internal_error();

/// 499, which nobody reads: it is what the log then shows.
Problem client_closed_request();

/// HTTP's own phrase for a status.
std::string_view title_of(int status);

/// application/problem+json. Bytes that are not UTF-8 are replaced, never refused.
std::string to_json(const Problem& problem);

}  // namespace raytracer
