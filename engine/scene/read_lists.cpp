// Lists: what large scenes are made of.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "engine/memory/page_allocator.h"
#include "engine/scene/fields.h"
#include "engine/text/pluralised.h"

namespace raytracer {
namespace {

/// How many elements the array at another key of the same object has; nothing if there is none.
std::optional<std::size_t> count_items(const Field& field, std::string_view key) {
  JsonArray items;
  if (field.siblings.at_key(key).get(items)) return {};
  constexpr std::size_t counted = 0xFFFFFF;  // simdjson counts no further
  if (items.size() < counted) return items.size();
  return static_cast<std::size_t>(std::distance(items.begin(), items.end()));
}

/// Whether there are as many as items, or nobody knows how many of those.
bool has_one_for_each(const Field& field, std::size_t count, std::string_view noun,
                      std::string_view items, std::string_view what_to_do = "give one for each") {
  const std::optional<std::size_t> item_count = count_items(field, items);
  if (!item_count || count == *item_count) return true;
  field.refuse(
      fmt::format("{} for {} {}: {}", pluralised(count, noun), *item_count, items, what_to_do));
  return false;
}

/// While it lives, the values for which a list has room are written in huge pages: of a large scene
/// that takes half as long.
template <typename Value>
HugePages huge_pages_of(std::vector<Value>& list) {
  return {list.data(), list.capacity() * sizeof(Value)};
}

/// Three numbers in `range`; nothing, without an error, if it is something else.
std::optional<Vec3> get_triple(const JsonValue& value, const ValueRange& range) {
  JsonArray array;
  std::array<double, 3> numbers{};
  if (value.get(array) || !get_numbers(array, range, numbers)) return {};
  return Vec3{numbers[0], numbers[1], numbers[2]};
}

/// In place of a value that is wrong stands `otherwise`. get(value) returns most values that are
/// right, sooner than they are read; for others it returns nothing.
template <typename Rule, typename Value, typename Get>
std::optional<std::vector<Value>> read_list(const Field& field, const Rule& rule,
                                            const Value& otherwise, const Get& get) {
  const auto array = read_array(field);
  if (!array) return {};
  std::vector<Value> values;
  values.reserve(array->size());
  const HugePages pages = huge_pages_of(values);
  for (const JsonValue element : *array) {
    if (const std::optional<Value> value = get(element)) {
      values.push_back(*value);
      continue;
    }
    const Path path = field.path.child(values.size());
    values.push_back(read(Field{element, path, field.errors}, rule).value_or(otherwise));
  }
  return values;
}

/// As get_numbers().
std::optional<std::vector<double>> get_all_numbers(const JsonArray& array,
                                                   const ValueRange& range) {
  std::vector<double> numbers;
  numbers.reserve(array.size());
  const HugePages pages = huge_pages_of(numbers);
  numbers.resize(array.size());
  if (!get_numbers(array, range, numbers)) return {};
  return numbers;
}

}  // namespace

std::optional<std::vector<Vec3>> read(const Field& field, const PointsRule&) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return read_list(field, PointRule{}, Vec3{nan, nan, nan},  // differs from all points
                   [](const JsonValue& value) { return get_triple(value, any_number); });
}

std::optional<std::vector<Vec3>> read(const Field& field, const OtherPointPerItemRule& rule) {
  auto points = read(field, PointsRule{});
  if (!points || !has_one_for_each(field, points->size(), "point", rule.items)) return {};
  const auto others = read_sibling(field, rule.items, PointsRule{});
  if (!others) return points;
  for (std::size_t i = 0; i < std::min(points->size(), others->size()); ++i)
    if ((*points)[i] == (*others)[i])
      field.errors.add(ErrorKind::invalid, field.path.child(i), [&] {
        return fmt::format("must differ from item {} of {}", i, rule.items);
      });
  return points;
}

std::optional<std::vector<Vec3>> read(const Field& field, const DirectionPerItemRule& rule) {
  auto directions = read_list(field, DirectionRule{}, Vec3{}, [](const JsonValue& value) {
    const std::optional<Vec3> direction = get_triple(value, any_number);
    return direction == Vec3{} ? std::nullopt : direction;  // it is read, which complains
  });
  if (directions && !has_one_for_each(field, directions->size(), "vector", rule.items)) return {};
  return directions;
}

std::optional<std::vector<Rgb>> read(const Field& field, const ColorPerItemRule& rule) {
  auto colors = read_list(field, ColorRule{}, Rgb{},
                          [](const JsonValue& value) { return get_triple(value, unit_interval); });
  if (colors && !has_one_for_each(field, colors->size(), "color", rule.items)) return {};
  return colors;
}

std::optional<std::vector<double>> read(const Field& field, const NumberPerItemRule& rule) {
  const NumberRule one{rule.range};
  if (!field.value.is_array()) {
    const std::optional<double> number = read(field, one);
    if (!number) return {};
    return std::vector{*number};
  }
  const JsonArray array = field.value.get_array().value_unsafe();
  std::optional<std::vector<double>> numbers = get_all_numbers(array, rule.range);
  if (!numbers)
    numbers = read_list(field, one, 1.0, [](const JsonValue&) { return std::optional<double>(); });
  if (!has_one_for_each(field, numbers->size(), "number", rule.items,
                        "give one number, or one for each"))
    return {};
  const bool all_equal = std::all_of(numbers->begin(), numbers->end(),
                                     [&](double number) { return number == numbers->front(); });
  if (all_equal && !numbers->empty()) numbers->resize(1);
  return numbers;
}

std::optional<std::vector<double>> read(const Field& field, const NotBothZeroPerItemRule& rule) {
  const NumberPerItemRule each{not_negative, rule.items};
  auto numbers = read(field, each);
  const auto others = read_sibling(field, rule.other, each);
  if (!numbers || !others || numbers->empty() || others->empty()) return numbers;
  const auto is_zero = [](const std::vector<double>& values, std::size_t i) {
    return values[values.size() == 1 ? 0 : std::min(i, values.size() - 1)] == 0;
  };
  for (std::size_t i = 0; i < std::max(numbers->size(), others->size()); ++i)
    if (is_zero(*numbers, i) && is_zero(*others, i))
      field.errors.add(ErrorKind::invalid,
                       field.value.is_array() ? field.path.child(i) : field.path,
                       [&] { return NotBothZeroRule{rule.other}.complaint(0, 0); });
  return numbers;
}

std::optional<std::vector<std::array<std::uint32_t, 3>>> read(const Field& field,
                                                              const TriplesRule& rule) {
  const auto array = read_array(field);
  if (!array) return {};
  const std::optional<std::size_t> item_count = count_items(field, rule.items);
  if (item_count == 0 && array->size() > 0) {
    field.refuse(fmt::format("must be empty: there are no {}", rule.items));
    return {};
  }
  constexpr std::int64_t largest_index = std::numeric_limits<std::uint32_t>::max();
  const IntegerRule valid{0,
                          item_count ? static_cast<std::int64_t>(*item_count) - 1 : largest_index};
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(array->size());
  const HugePages pages = huge_pages_of(triangles);
  read_elements(field, *array, [&](const Field& element) {
    const auto corners = read_array(element);
    if (!corners) return;
    std::array<double, 3> corner{};
    const auto is_valid = [&](double index) { return valid.complaint(index).empty(); };
    if (get_numbers(*corners, any_number, corner) &&
        std::all_of(corner.begin(), corner.end(), is_valid)) {
      std::transform(corner.begin(), corner.end(), triangles.emplace_back().begin(),
                     [](double index) { return static_cast<std::uint32_t>(index); });
      return;
    }
    std::size_t count = 0;
    read_elements(element, *corners, [&](const Field& index) {
      read(index, valid);
      ++count;
    });
    if (count != corner.size())
      element.refuse(fmt::format("must be three indices, not {} values", count));
  });
  return triangles;
}

}  // namespace raytracer
