// The outcome of reading something from outside: a value, or everything that is wrong with it.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace raytracer {

/// What kind of wrong: the service answers each with a status of its own.
enum class ErrorKind {
  syntax,   ///< not JSON at all
  invalid,  ///< JSON, but against a rule of the scene document
  limit,    ///< valid, but more than this service was told to accept
};

struct Error {
  ErrorKind kind = ErrorKind::invalid;
  std::string pointer;  ///< JSON Pointer (RFC 6901) into the document; empty is the whole
  std::string detail;   ///< a sentence for a person: what is wrong and what would be right
};

/// Either a T or a non-empty list of errors.
template <typename T>
class Result {
 public:
  Result(T value) : content_(std::move(value)) {}                     // NOLINT: implicit on purpose
  Result(std::vector<Error> errors) : content_(std::move(errors)) {}  // NOLINT: as above

  bool ok() const { return std::holds_alternative<T>(content_); }

  /// The value; throws std::bad_variant_access if there is none.
  const T& value() const& { return std::get<T>(content_); }
  T&& value() && { return std::get<T>(std::move(content_)); }

  /// The errors; throws std::bad_variant_access if there is a value.
  const std::vector<Error>& errors() const { return std::get<std::vector<Error>>(content_); }

 private:
  std::variant<T, std::vector<Error>> content_;
};

}  // namespace raytracer
