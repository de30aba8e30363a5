#include "engine/scene/fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "engine/scene/camera.h"
#include "engine/scene/nearest_key.h"

namespace raytracer {
namespace {

std::string_view name_of(JsonKind kind) {
  switch (kind) {
    case JsonKind::null:
      return "null";
    case JsonKind::boolean:
      return "a boolean";
    case JsonKind::number:
      return "a number";
    case JsonKind::string:
      return "a string";
    case JsonKind::array:
      return "an array";
    case JsonKind::object:
      return "an object";
  }
  return "";
}

bool expect(const Field& field, JsonKind kind, std::string_view wanted) {
  if (field.value.kind() == kind) return true;
  field.refuse(fmt::format("must be {}, not {}", wanted, name_of(field.value.kind())));
  return false;
}

std::optional<double> number_within(const Field& field, const ValueRange& range) {
  return read(field, NumberRule{range}, ObjectReader(field));
}

/// Exactly three numbers within `range`.
std::optional<Vec3> read_triple(const Field& field, const ValueRange& range,
                                std::string_view wanted) {
  if (!expect(field, JsonKind::array, wanted)) return {};
  const std::span<const double> valid = numbers_within(field.value, range);
  if (valid.size() == 3) return Vec3{valid[0], valid[1], valid[2]};
  std::array<std::optional<double>, 3> numbers;
  std::size_t count = 0;
  read_elements(field, [&](const Field& element) {
    if (count < numbers.size()) numbers[count] = number_within(element, range);
    ++count;
  });
  if (count != numbers.size()) {
    field.refuse(fmt::format("must be {}, not {} values", wanted, count));
    return {};
  }
  if (!numbers[0] || !numbers[1] || !numbers[2]) return {};
  return Vec3{*numbers[0], *numbers[1], *numbers[2]};
}

/// Nothing also for what is beyond all doubles, as was noted when it was parsed.
std::optional<double> any_double(const Field& field, std::string_view wanted) {
  if (!expect(field, JsonKind::number, wanted)) return {};
  const double value = field.value.number();
  if (std::isnan(value)) return {};
  return value;
}

std::optional<double> integer_within(const Field& field, const ValueRange& range) {
  const std::optional<double> value = any_double(field, "an integer");
  if (!value) return {};
  if (*value != std::floor(*value)) {
    field.refuse(fmt::format("{} must be an integer", *value));
    return {};
  }
  if (range.contains(*value)) return value;
  field.refuse(fmt::format("{} is out of range: must be an integer {}", *value, range.describe()));
  return {};
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

}  // namespace

std::span<const double> numbers_within(const JsonValue& value, const ValueRange& range) {
  const std::span<const double> numbers = value.numbers();
  const bool is_valid = std::all_of(numbers.begin(), numbers.end(),
                                    [&](double number) { return range.contains(number); });
  return is_valid ? numbers : std::span<const double>{};
}

std::optional<double> read(const Field& field, const NumberRule& rule, const ObjectReader&) {
  const std::optional<double> value = any_double(field, "a number");
  if (!value || rule.range.contains(*value)) return value;
  field.refuse(fmt::format("{} is out of range: must be {}", *value, rule.range.describe()));
  return {};
}

std::optional<std::int64_t> read(const Field& field, const IntegerRule& rule, const ObjectReader&) {
  const std::optional<double> value = integer_within(
      field, {.least = static_cast<double>(rule.least), .most = static_cast<double>(rule.most)});
  if (!value) return {};
  return static_cast<std::int64_t>(*value);
}

std::optional<int> read(const Field& field, const CountRule& rule, const ObjectReader&) {
  const std::optional<double> value =
      integer_within(field, {.least = static_cast<double>(rule.least)});
  if (!value) return {};
  return static_cast<int>(std::min<double>(*value, std::numeric_limits<int>::max()));
}

std::optional<bool> read(const Field& field, const FlagRule&, const ObjectReader&) {
  if (!expect(field, JsonKind::boolean, "true or false")) return {};
  return field.value.boolean();
}

std::optional<double> read(const Field& field, const FieldOfViewRule&, const ObjectReader&) {
  const std::optional<double> angle = any_double(field, "a number");
  if (!angle || is_field_of_view(*angle)) return angle;
  field.refuse(fmt::format("{} is out of range: {}", *angle, fov_rule));
  return {};
}

std::optional<std::string_view> read_string(const Field& field) {
  if (!expect(field, JsonKind::string, "a string")) return {};
  return field.value.string();
}

std::optional<Vec3> read(const Field& field, const PointRule&, const ObjectReader&) {
  return read_triple(field, any_number, "three numbers");
}

std::optional<Vec3> read(const Field& field, const OtherPointRule& rule, const ObjectReader& of) {
  const std::optional<Vec3> point = read(field, PointRule{}, of);
  const auto other = of.peek(rule.other, [&](const Field& f) { return read(f, PointRule{}, of); });
  if (!point || point != other) return point;
  field.refuse(fmt::format("must differ from {}: {}", rule.other, rule.reason));
  return {};
}

std::optional<Vec3> read(const Field& field, const DirectionRule&, const ObjectReader&) {
  const std::optional<Vec3> direction = read_triple(field, any_number, "three numbers");
  if (direction != Vec3{}) return direction;
  field.refuse("the zero vector has no direction");
  return {};
}

std::optional<Rgb> read(const Field& field, const ColorRule&, const ObjectReader&) {
  constexpr std::string_view wanted = "three numbers from 0 to 1 or \"#rrggbb\"";
  if (field.value.kind() != JsonKind::string) return read_triple(field, unit_interval, wanted);
  const std::string_view text = field.value.string();
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

std::optional<std::size_t> read_choice(const Field& field,
                                       std::span<const std::string_view> words) {
  const std::optional<std::string_view> word = read_string(field);
  if (!word) return {};
  const auto found = std::find(words.begin(), words.end(), *word);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  field.refuse_by([&] {
    return fmt::format("\"{}\" is not one of \"{}\"; did you mean \"{}\"?", *word,
                       fmt::join(words, "\", \""), nearest_key(*word, words));
  });
  return {};
}

bool expect_array(const Field& field) { return expect(field, JsonKind::array, "an array"); }

ObjectReader::ObjectReader(const Field& field, std::span<const std::string_view> known)
    : field_(field), is_object_(expect(field, JsonKind::object, "an object")) {
  if (!is_object_) return;
  std::set<std::string_view> unknown;  // each once, though it stands twice
  field.value.for_each_member([&](std::string_view key, JsonValue value) {
    if (std::find(known.begin(), known.end(), key) != known.end()) return;
    if (!unknown.insert(key).second) return;
    const Path path = field.path.child(key);
    Field{value, path, field.errors}.refuse_by([&] {
      return fmt::format("unknown key \"{}\"; did you mean \"{}\"?", key, nearest_key(key, known));
    });
  });
}

std::optional<std::size_t> ObjectReader::element_count(std::string_view key) const {
  const auto value = is_object_ ? field_.value.member(key) : std::nullopt;
  if (!value || value->kind() != JsonKind::array) return {};
  std::size_t count = value->numbers().size();
  if (count > 0) return count;
  value->for_each_element([&](JsonValue) { ++count; });
  return count;
}

}  // namespace raytracer
