// Reading one JSON value as what it should be, or noting what is wrong with it.
//
// Every read_* function returns the value, or nothing after it has added an error that names the
// place. A reader goes on after an error, so that all of a document's errors are found at once.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/fields/field_table.h"
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

/// The elements of an array of numbers, if all are in `range`; otherwise nothing, and no error:
/// large scenes are made of these, and one that fails is looked at again number by number.
std::span<const double> numbers_within(const JsonValue& value, const ValueRange& range);

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
  ObjectReader(const Field& field, std::span<const std::string_view> known);
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

  /// What read(Field) makes of the member `key`, its errors unheard.
  template <typename Read>
  auto peek(std::string_view key, const Read& read) const -> decltype(read(std::declval<Field>())) {
    const auto value = is_object_ ? field_.value.member(key) : std::nullopt;
    if (!value) return {};
    ErrorList unheard;
    const Path path = field_.path.child(key);
    return read(Field{*value, path, unheard});
  }

  /// How many elements the array at `key` has; nothing if there is no array there.
  std::optional<std::size_t> element_count(std::string_view key) const;

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

// One function for each rule of engine/fields/field_rules.h. `of` is the object that the field is
// in.
std::optional<double> read(const Field& field, const NumberRule& rule, const ObjectReader& of);
std::optional<std::int64_t> read(const Field& field, const IntegerRule& rule,
                                 const ObjectReader& of);
std::optional<int> read(const Field& field, const CountRule& rule, const ObjectReader& of);
std::optional<bool> read(const Field& field, const FlagRule& rule, const ObjectReader& of);
std::optional<double> read(const Field& field, const FieldOfViewRule& rule, const ObjectReader& of);
std::optional<Vec3> read(const Field& field, const PointRule& rule, const ObjectReader& of);
std::optional<Vec3> read(const Field& field, const OtherPointRule& rule, const ObjectReader& of);
std::optional<Vec3> read(const Field& field, const DirectionRule& rule, const ObjectReader& of);
std::optional<Rgb> read(const Field& field, const ColorRule& rule, const ObjectReader& of);
std::optional<std::vector<Vec3>> read(const Field& field, const PointsRule& rule,
                                      const ObjectReader& of);
std::optional<std::vector<Vec3>> read(const Field& field, const OtherPointPerItemRule& rule,
                                      const ObjectReader& of);
std::optional<std::vector<double>> read(const Field& field, const NumberPerItemRule& rule,
                                        const ObjectReader& of);
std::optional<std::vector<Rgb>> read(const Field& field, const ColorPerItemRule& rule,
                                     const ObjectReader& of);
std::optional<std::vector<std::array<std::uint32_t, 3>>> read(const Field& field,
                                                              const TriplesRule& rule,
                                                              const ObjectReader& of);

/// The index of the string among `words`.
std::optional<std::size_t> read_choice(const Field& field, std::span<const std::string_view> words);
template <std::size_t count>
std::optional<std::size_t> read(const Field& field, const ChoiceRule<count>& rule,
                                const ObjectReader&) {
  return read_choice(field, rule.words);
}

std::optional<std::string_view> read_string(const Field& field);

/// Sets the members of `owner` whose fields are there and right.
template <typename Owner, typename... Fields>
void read_fields(const ObjectReader& object, const std::tuple<Fields...>& table, Owner& owner) {
  for_each_field(table, [&](const auto& row) {
    const auto read_row = [&](const Field& field) { return read(field, row.rule, object); };
    if (row.is_required)
      object.required(row.key, owner.*row.member, read_row);
    else
      object.optional(row.key, owner.*row.member, read_row);
  });
}

}  // namespace raytracer
