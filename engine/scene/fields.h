// Reading one JSON value as what it should be, or noting what is wrong with it.
//
// Every read_* function returns the value, or nothing after it has added an error that names the
// place. A reader goes on after an error, so that all of a document's errors are found at once.
#pragma once

#include <fmt/format.h>

#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/math/vec.h"
#include "engine/scene/document.h"
#include "engine/scene/error_list.h"
#include "engine/scene/path.h"
#include "engine/scene/result.h"

namespace raytracer {

/// A value, its place, and where to complain about it.
struct Field {
  JsonValue value;
  const Path& path;
  ErrorList& errors;

  void refuse(std::string detail) const { errors.add(ErrorKind::invalid, path, std::move(detail)); }
  /// The same where `describe()` takes long: it is not called for errors that are only counted.
  template <typename Describe>
  void refuse_by(const Describe& describe) const {
    if (errors.is_full())
      errors.add_unlisted();
    else
      refuse(describe());
  }
};

/// An interval of doubles, with the words for it.
struct ValueRange {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool least_excluded = false;

  bool contains(double value) const {
    return (least_excluded ? value > least : value >= least) && value <= most;
  }
  std::string describe() const;
};

inline constexpr ValueRange any_number{};
inline constexpr ValueRange not_negative{.least = 0};
inline constexpr ValueRange positive{.least = 0, .least_excluded = true};
inline constexpr ValueRange unit_interval{.least = 0, .most = 1};

/// The elements of an array of numbers, if all are in `range`; otherwise nothing, and no error:
/// large scenes are made of these, and one that fails is looked at again number by number.
std::span<const double> numbers_within(const JsonValue& value, const ValueRange& range);

std::optional<double> read_number(const Field& field, const ValueRange& range = any_number);

/// A number without a fraction, 3 and 3.0 alike, from `least` to `most`.
std::optional<std::int64_t> read_integer(const Field& field, std::int64_t least, std::int64_t most);

std::optional<std::string_view> read_string(const Field& field);

/// Three numbers.
std::optional<Vec3> read_point(const Field& field);

/// Three numbers, not all of them 0.
std::optional<Vec3> read_direction(const Field& field);

/// Three numbers in [0, 1], or "#rrggbb".
std::optional<Rgb> read_color(const Field& field);

/// The index of the string among `words`.
std::optional<std::size_t> read_choice(const Field& field, std::span<const std::string_view> words);

/// True for an array; notes an error otherwise.
bool expect_array(const Field& field);

/// Calls read(Field) for each element of an array.
template <typename Read>
void read_elements(const Field& field, Read read) {
  std::size_t index = 0;
  field.value.for_each_element([&](JsonValue element) {
    const Path path = field.path.child(index++);
    read(Field{element, path, field.errors});
  });
}

/// An object's members by key. On construction it notes a value that is no object, and every key
/// that is not among `known`, with the nearest that is.
class ObjectReader {
 public:
  ObjectReader(const Field& field, std::initializer_list<std::string_view> known);
  /// Of whatever keys, and of a value that has none if it is no object.
  explicit ObjectReader(const Field& field)
      : field_(field), is_object_(field.value.kind() == JsonKind::object) {}

  /// Sets `out` to what read(Field) returns for the member `key`, if it is there and right.
  template <typename T, typename Read>
  void optional(std::string_view key, T& out, Read read) const {
    set(key, out, read);
  }

  /// As `optional`, and a missing key is an error.
  template <typename T, typename Read>
  void required(std::string_view key, T& out, Read read) const {
    if (!set(key, out, read) && is_object_)
      field_.errors.add(ErrorKind::invalid, field_.path.child(key),
                        fmt::format("\"{}\" is required", key));
  }

 private:
  template <typename T, typename Value>
  static void assign(T& out, Value value) {
    out = static_cast<T>(std::move(value));
  }
  template <typename T, typename Value>
  static void assign(std::optional<T>& out, Value value) {
    out = static_cast<T>(std::move(value));
  }

  /// False if there is no member `key`.
  template <typename T, typename Read>
  bool set(std::string_view key, T& out, Read read) const {
    const auto value = is_object_ ? field_.value.member(key) : std::nullopt;
    if (!value) return false;
    const Path path = field_.path.child(key);
    if (auto content = read(Field{*value, path, field_.errors})) assign(out, *std::move(content));
    return true;
  }

  const Field& field_;
  bool is_object_;
};

}  // namespace raytracer
