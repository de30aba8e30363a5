#include "engine/scene/fields.h"

#include <algorithm>
#include <limits>
#include <set>

#include "engine/scene/nearest_key.h"

namespace raytracer {
namespace {

using simdjson::dom::element_type;

std::string_view name_of(element_type type) {
  switch (type) {
    case element_type::NULL_VALUE:
      return "null";
    case element_type::BOOL:
      return "a boolean";
    case element_type::INT64:
    case element_type::UINT64:
    case element_type::DOUBLE:
      return "a number";
    case element_type::STRING:
      return "a string";
    case element_type::ARRAY:
      return "an array";
    case element_type::OBJECT:
      return "an object";
  }
  return "";
}

template <typename T>
std::optional<T> read_as(const Field& field, std::string_view wanted) {
  T content;
  if (!field.value.get(content)) return content;
  field.refuse(fmt::format("must be {}, not {}", wanted, name_of(field.value.type())));
  return {};
}

/// Nothing also for what is beyond all doubles, as was noted when it was parsed.
std::optional<double> read_double(const Field& field, std::string_view wanted) {
  if (field.value.type() == element_type::UINT64) return {};
  return read_as<double>(field, wanted);
}

/// The value if the rule has no complaint about it.
template <typename Value, typename Rule>
std::optional<Value> checked(const Field& field, const std::optional<Value>& value,
                             const Rule& rule) {
  if (!value) return {};
  std::string complaint = rule.complaint(*value);
  if (complaint.empty()) return value;
  field.refuse(std::move(complaint));
  return {};
}

/// Exactly three numbers within `range`.
std::optional<Vec3> read_triple(const Field& field, const ValueRange& range,
                                std::string_view wanted) {
  const auto array = read_array(field, wanted);
  if (!array) return {};
  std::array<double, 3> numbers{};
  if (get_numbers(*array, range, numbers)) return Vec3{numbers[0], numbers[1], numbers[2]};
  std::size_t count = 0;
  read_elements(field, *array, [&](const Field& element) {
    if (count++ < numbers.size()) read(element, NumberRule{range});
  });
  if (count != numbers.size())
    field.refuse(fmt::format("must be {}, not {} values", wanted, count));
  return {};
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// `wanted` says what it may be.
std::optional<Rgb> read_color(const Field& field, std::string_view wanted) {
  if (!field.value.is_string()) return read_triple(field, unit_interval, wanted);
  const std::string_view text = field.value.get_string().value_unsafe();
  const bool well_formed =
      text.size() == 7 && text[0] == '#' &&
      std::all_of(text.begin() + 1, text.end(), [](char c) { return hex_digit(c) >= 0; });
  if (!well_formed) {
    field.refuse(fmt::format("\"{}\" is not a colour: must be {}", text, wanted));
    return {};
  }
  const auto channel = [&](std::size_t at) {
    return (16 * hex_digit(text[at]) + hex_digit(text[at + 1])) / 255.0;
  };
  return Rgb{channel(1), channel(3), channel(5)};
}

}  // namespace

std::optional<std::string_view> read_string(const Field& field) {
  return read_as<std::string_view>(field, "a string");
}

std::optional<JsonArray> read_array(const Field& field, std::string_view wanted) {
  return read_as<JsonArray>(field, wanted);
}

bool get_numbers(const JsonArray& array, const ValueRange& range, std::span<double> numbers) {
  auto next = numbers.begin();
  for (const JsonValue element : array) {
    if (next == numbers.end() || element.get(*next) || !range.contains(*next)) return false;
    ++next;
  }
  return next == numbers.end();
}

std::optional<ObjectReader> read_object(const Field& field) {
  const auto object = read_as<JsonObject>(field, "an object");
  if (!object) return {};
  return ObjectReader(*object, field);
}

void ObjectReader::refuse_keys_but(std::span<const std::string_view> known) const {
  std::set<std::string_view> unknown;  // each once, though it stands twice
  for_each([&](std::string_view key, const Field& member) {
    if (std::find(known.begin(), known.end(), key) != known.end()) return;
    if (!unknown.insert(key).second) return;
    member.errors.add_about_key(member.path, [&] {
      return fmt::format("unknown key \"{}\"; did you mean \"{}\"?", key, nearest_key(key, known));
    });
  });
}

std::optional<double> read(const Field& field, const NumberRule& rule) {
  return checked(field, read_double(field, "a number"), rule);
}

std::optional<std::int64_t> read(const Field& field, const IntegerRule& rule) {
  const std::optional<double> value = checked(field, read_double(field, "an integer"), rule);
  if (!value) return {};
  return static_cast<std::int64_t>(*value);
}

std::optional<int> read(const Field& field, const CountRule& rule) {
  const std::optional<double> value = checked(field, read_double(field, "an integer"), rule);
  if (!value) return {};
  return static_cast<int>(std::min<double>(*value, std::numeric_limits<int>::max()));
}

std::optional<double> read(const Field& field, const NotBothZeroRule& rule) {
  const std::optional<double> number = read(field, NumberRule{not_negative});
  const std::optional<double> other = read_sibling(field, rule.other, NumberRule{not_negative});
  if (!number || !other || *number != 0 || *other != 0) return number;
  field.refuse(rule.complaint(*number, *other));
  return {};
}

std::optional<bool> read(const Field& field, const FlagRule&) {
  return read_as<bool>(field, "true or false");
}

std::optional<double> read(const Field& field, const FieldOfViewRule& rule) {
  return checked(field, read_double(field, "a number"), rule);
}

std::optional<Vec3> read(const Field& field, const PointRule&) {
  return read_triple(field, any_number, "three numbers");
}

std::optional<Vec3> read(const Field& field, const OtherPointRule& rule) {
  const std::optional<Vec3> point = read(field, PointRule{});
  const std::optional<Vec3> other = read_sibling(field, rule.other, PointRule{});
  if (!point || point != other) return point;
  field.refuse(rule.complaint(*point, *other));
  return {};
}

std::optional<Vec3> read(const Field& field, const DirectionRule& rule) {
  return checked(field, read(field, PointRule{}), rule);
}

std::optional<Rgb> read(const Field& field, const ColorRule&) {
  return read_color(field, "three numbers from 0 to 1 or \"#rrggbb\"");
}

std::optional<std::optional<Rgb>> read(const Field& field, const BackgroundRule&) {
  if (field.value.is_string() && field.value.get_string().value_unsafe() == "transparent")
    return std::optional<Rgb>();
  const std::optional<Rgb> color =
      read_color(field, "three numbers from 0 to 1, \"#rrggbb\" or \"transparent\"");
  if (!color) return {};
  return color;
}

std::optional<std::size_t> read_choice(const Field& field,
                                       std::span<const std::string_view> words) {
  const std::optional<std::string_view> word = read_string(field);
  if (!word) return {};
  const auto found = std::find(words.begin(), words.end(), *word);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  field.refuse([&] {
    return fmt::format("\"{}\" is not one of \"{}\"{}", *word, fmt::join(words, "\", \""),
                       did_you_mean(*word, words));
  });
  return {};
}

}  // namespace raytracer
