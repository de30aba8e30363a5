// Reading one JSON value as what it should be, or noting what is wrong with it.
//
// Every read function returns the value, or nothing after it has added an error that names the
// place. A reader goes on after an error, so that all of a document's errors are found at once.
#pragma once

#include <fmt/format.h>

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/fields/field_table.h"
#include "engine/fields/types.h"
#include "engine/math/vec.h"
#include "engine/scene/document.h"
#include "engine/scene/error_list.h"
#include "engine/scene/path.h"

namespace raytracer {

/// A value, its place, and where to complain about it.
struct Field {
  JsonValue value;
  const Path& path;
  ErrorList& errors;
  JsonObject siblings{};  ///< of a member of an object: all members

  void refuse(std::string detail) const { errors.add(ErrorKind::invalid, path, std::move(detail)); }
  /// The same with what describe() returns, which is not asked for errors that are only counted.
  template <std::invocable Describe>
  void refuse(const Describe& describe) const {
    errors.add(ErrorKind::invalid, path, describe);
  }
};

std::optional<std::string_view> read_string(const Field& field);
std::optional<JsonArray> read_array(const Field& field, std::string_view wanted = "an array");

/// Calls read(Field) for each element.
template <typename Read>
void read_elements(const Field& field, const JsonArray& array, const Read& read) {
  std::size_t index = 0;
  for (const JsonValue element : array) {
    const Path path = field.path.child(index++);
    read(Field{element, path, field.errors});
  }
}

/// Fills `numbers` with an array's elements if they are that many, all numbers in `range`. False
/// otherwise, without an error: large scenes are made of these, and an array that fails is read
/// again, number by number.
bool get_numbers(const JsonArray& array, const ValueRange& range, std::span<double> numbers);

/// An object's members by key.
class ObjectReader {
 public:
  ObjectReader(const JsonObject& object, const Field& field) : object_(object), field_(field) {}

  /// Calls read(key, Field) for each member, duplicates included.
  template <typename Read>
  void for_each(const Read& read) const {
    for (const auto& member : object_) {
      const Path path = field_.path.child(member.key);
      read(member.key, Field{member.value, path, field_.errors, object_});
    }
  }

  /// Notes every key that is not among `known`, with the nearest that is.
  void refuse_keys_but(std::span<const std::string_view> known) const;

  /// Sets `out` to what read(Field) returns for the member `key`, if it is there and right.
  /// Returns whether it is there.
  template <typename T, typename Read>
  bool optional(std::string_view key, T& out, const Read& read) const {
    const auto value = object_.at_key(key);
    if (value.error()) return false;
    const Path path = field_.path.child(key);
    if (auto content = read(Field{value.value_unsafe(), path, field_.errors, object_}))
      out = static_cast<T>(*std::move(content));
    return true;
  }

  /// As `optional`, and a missing key is an error.
  template <typename T, typename Read>
  void required(std::string_view key, T& out, const Read& read) const {
    if (!optional(key, out, read))
      field_.errors.add(ErrorKind::invalid, field_.path.child(key),
                        fmt::format("\"{}\" is required", key));
  }

 private:
  JsonObject object_;
  const Field& field_;
};

std::optional<ObjectReader> read_object(const Field& field);

// One function for each rule of engine/fields/field_rules.h.
std::optional<double> read(const Field& field, const NumberRule& rule);
std::optional<double> read(const Field& field, const NotBothZeroRule& rule);
std::optional<std::int64_t> read(const Field& field, const IntegerRule& rule);
std::optional<int> read(const Field& field, const CountRule& rule);
std::optional<bool> read(const Field& field, const FlagRule& rule);
std::optional<double> read(const Field& field, const FieldOfViewRule& rule);
std::optional<Vec3> read(const Field& field, const PointRule& rule);
std::optional<Vec3> read(const Field& field, const OtherPointRule& rule);
std::optional<Vec3> read(const Field& field, const DirectionRule& rule);
std::optional<Rgb> read(const Field& field, const ColorRule& rule);
std::optional<std::optional<Rgb>> read(const Field& field, const BackgroundRule& rule);
std::optional<std::vector<Vec3>> read(const Field& field, const PointsRule& rule);
std::optional<std::vector<Vec3>> read(const Field& field, const OtherPointPerItemRule& rule);
std::optional<std::vector<Vec3>> read(const Field& field, const DirectionPerItemRule& rule);
std::optional<std::vector<double>> read(const Field& field, const NumberPerItemRule& rule);
std::optional<std::vector<double>> read(const Field& field, const NotBothZeroPerItemRule& rule);
std::optional<std::vector<Rgb>> read(const Field& field, const ColorPerItemRule& rule);
std::optional<std::vector<std::array<std::uint32_t, 3>>> read(const Field& field,
                                                              const TriplesRule& rule);

/// What another member of the same object is, its errors unheard.
template <typename Rule>
auto read_sibling(const Field& field, std::string_view key, const Rule& rule)
    -> decltype(read(field, rule)) {
  const auto value = field.siblings.at_key(key);
  if (value.error()) return {};
  ErrorList unheard;
  return read(Field{value.value_unsafe(), field.path, unheard, field.siblings}, rule);
}

/// The index of the string among `words`.
std::optional<std::size_t> read_choice(const Field& field, std::span<const std::string_view> words);
template <std::size_t count>
std::optional<std::size_t> read(const Field& field, const ChoiceRule<count>& rule) {
  return read_choice(field, rule.words);
}

/// Sets the members of `owner` whose fields are there and right.
template <typename Owner, typename... Fields>
void read_fields(const ObjectReader& object, const std::tuple<Fields...>& table, Owner& owner) {
  for_each_field(table, [&](const auto& row) {
    const auto read_row = [&](const Field& field) { return read(field, row.rule); };
    if (row.is_required)
      object.required(row.key, owner.*row.member, read_row);
    else
      object.optional(row.key, owner.*row.member, read_row);
  });
}

/// Reads a structure that an object says with the keys of its table and no others, as far as they
/// are right.
template <typename Structure>
std::optional<Structure> read_structure(const Field& field) {
  const std::optional<ObjectReader> object = read_object(field);
  if (!object) return {};
  object->refuse_keys_but(keys_of(Structure::fields));
  Structure structure;
  read_fields(*object, Structure::fields, structure);
  return structure;
}

/// Reads an object as that of the structures whose `type` it says, {"type": "sphere", ...}; nothing
/// if there is none: then keys that no type has are refused. What an object of any type may have,
/// with the keys `also`, is what read_others(object) reads.
template <typename Variant, typename... Structure, std::size_t also_count, typename ReadOthers>
std::optional<Variant> read_typed(const Field& field, Types<Structure...>,
                                  const std::array<std::string_view, also_count>& also,
                                  const ReadOthers& read_others) {
  const std::optional<ObjectReader> object = read_object(field);
  if (!object) return {};
  static constexpr std::array<std::string_view, sizeof...(Structure)> words{Structure::type...};
  std::optional<std::size_t> type;
  object->required("type", type, [](const Field& word) { return read_choice(word, words); });
  if (!type) {
    std::vector<std::string_view> of_any{"type"};
    of_any.insert(of_any.end(), also.begin(), also.end());
    const auto add = [&](const auto& keys) {
      of_any.insert(of_any.end(), keys.begin(), keys.end());
    };
    (add(keys_of(Structure::fields)), ...);
    object->refuse_keys_but(of_any);
  }
  std::optional<Variant> content;
  const auto read_if_said = [&]<typename Said>(std::type_identity<Said>) {
    if (!type || words[*type] != Said::type) return;
    object->refuse_keys_but(
        std::apply([](auto... key) { return keys_of(Said::fields, "type", key...); }, also));
    Said structure;
    read_fields(*object, Said::fields, structure);
    content = std::move(structure);
  };
  (read_if_said(std::type_identity<Structure>{}), ...);
  read_others(*object);
  return content;
}

}  // namespace raytracer
