// What a client is told when it does not get what it asked for: RFC 9457, and the one place where
// the engine's errors become an HTTP status.
#pragma once

#include <exception>
#include <string>
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

/// Ends a request with a problem of this status; 499 is for a client that has left, and its log.
[[noreturn]] void refuse(int status, std::string detail,
                         std::vector<std::pair<std::string, std::string>> headers = {});

/// The answer to a document with these errors, at least one, all of them: not JSON 400, against the
/// rules 422, and only if nothing but limits is exceeded 413.
Problem scene_problem(std::vector<Error> errors);

/// 500: what is wrong is the server's business, and in its log.
Problem internal_error();

/// application/problem+json. Bytes that are not UTF-8 are replaced, never refused.
std::string to_json(const Problem& problem);

}  // namespace raytracer
