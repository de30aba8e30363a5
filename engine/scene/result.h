// The outcome of reading something from outside: a value, or everything that is wrong with it.
#pragma once

#include <cstdint>
#include <optional>
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

/// Where and why a text is not JSON.
struct SyntaxError {
  std::int64_t line = 1;    ///< from 1
  std::int64_t column = 1;  ///< from 1, in characters
  std::string reason;
};

struct Error {
  ErrorKind kind = ErrorKind::invalid;
  std::string pointer;        ///< JSON Pointer (RFC 6901) into the document; empty is the whole
  std::string detail;         ///< a sentence for a person: what is wrong and what would be right
  bool is_about_key = false;  ///< the name at the pointer's end is wrong, whatever its value is
  std::optional<SyntaxError> syntax{};  ///< of text that is not JSON; the detail says the same
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
