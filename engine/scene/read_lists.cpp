// Lists: what large scenes are made of.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/scene/fields.h"
#include "engine/text/pluralised.h"

namespace raytracer {
namespace {

/// Whether there are as many as items, or nobody knows how many of those.
bool has_one_for_each(const Field& field, std::size_t count, std::string_view noun,
                      std::string_view items, const ObjectReader& of,
                      std::string_view what_to_do = "give one for each") {
  const std::optional<std::size_t> item_count = of.element_count(items);
  if (!item_count || count == *item_count) return true;
  field.refuse(
      fmt::format("{} for {} {}: {}", pluralised(count, noun), *item_count, items, what_to_do));
  return false;
}

template <typename Rule>
auto read_list(const Field& field, const Rule& rule, const ObjectReader& of) {
  using Value = typename decltype(read(field, rule, of))::value_type;
  std::optional<std::vector<Value>> values;
  if (!expect_array(field)) return values;
  values.emplace();
  values->reserve(field.value.node_count());  // of arrays of numbers, one each
  read_elements(field, [&](const Field& element) {
    values->push_back(read(element, rule, of).value_or(Value{}));
  });
  return values;
}

}  // namespace

std::optional<std::vector<Vec3>> read(const Field& field, const PointsRule&,
                                      const ObjectReader& of) {
  return read_list(field, PointRule{}, of);
}

std::optional<std::vector<Vec3>> read(const Field& field, const OtherPointPerItemRule& rule,
                                      const ObjectReader& of) {
  auto points = read_list(field, PointRule{}, of);
  if (!points || !has_one_for_each(field, points->size(), "point", rule.items, of)) return {};
  const auto others =
      of.peek(rule.items, [&](const Field& f) { return read_list(f, PointRule{}, of); });
  if (!others) return points;
  for (std::size_t i = 0; i < std::min(points->size(), others->size()); ++i)
    if ((*points)[i] == (*others)[i]) {
      const Path path = field.path.child(i);
      Field{field.value, path, field.errors}.refuse_by(
          [&] { return fmt::format("must differ from item {} of {}", i, rule.items); });
    }
  return points;
}

std::optional<std::vector<Rgb>> read(const Field& field, const ColorPerItemRule& rule,
                                     const ObjectReader& of) {
  auto colors = read_list(field, ColorRule{}, of);
  if (colors && !has_one_for_each(field, colors->size(), "color", rule.items, of)) return {};
  return colors;
}

std::optional<std::vector<double>> read(const Field& field, const NumberPerItemRule& rule,
                                        const ObjectReader& of) {
  const NumberRule one{rule.range};
  if (field.value.kind() != JsonKind::array) {
    const std::optional<double> number = read(field, one, of);
    if (!number) return {};
    return std::vector{*number};
  }
  const std::span<const double> valid = numbers_within(field.value, rule.range);
  std::vector<double> numbers(valid.begin(), valid.end());
  if (numbers.empty())
    read_elements(field, [&](const Field& element) {
      numbers.push_back(read(element, one, of).value_or(1));
    });
  if (!has_one_for_each(field, numbers.size(), "number", rule.items, of,
                        "give one number, or one for each"))
    return {};
  const bool all_equal = std::all_of(numbers.begin(), numbers.end(),
                                     [&](double number) { return number == numbers.front(); });
  if (all_equal && !numbers.empty()) numbers.resize(1);
  return numbers;
}

std::optional<std::vector<std::array<std::uint32_t, 3>>> read(const Field& field,
                                                              const TriplesRule& rule,
                                                              const ObjectReader& of) {
  const std::optional<std::size_t> item_count = of.element_count(rule.items);
  constexpr std::int64_t largest_index = std::numeric_limits<std::uint32_t>::max();
  const std::int64_t last_vertex =
      item_count ? static_cast<std::int64_t>(*item_count) - 1 : largest_index;
  if (!expect_array(field)) return {};
  if (item_count == 0 && field.value.node_count() > 0) {
    field.refuse(fmt::format("must be empty: there are no {}", rule.items));
    return {};
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(field.value.node_count());
  const ValueRange valid_index{.least = 0, .most = static_cast<double>(last_vertex)};
  const auto is_integer = [](double number) { return number == std::floor(number); };
  read_elements(field, [&](const Field& element) {
    std::array<std::uint32_t, 3> triangle{};
    const std::span<const double> valid = numbers_within(element.value, valid_index);
    if (valid.size() == 3 && std::all_of(valid.begin(), valid.end(), is_integer)) {
      std::transform(valid.begin(), valid.end(), triangle.begin(),
                     [](double index) { return static_cast<std::uint32_t>(index); });
      triangles.push_back(triangle);
      return;
    }
    std::size_t count = 0;
    if (!expect_array(element)) return;
    read_elements(element, [&](const Field& corner) {
      const auto index = read(corner, IntegerRule{0, last_vertex}, of);
      if (index && count < 3) triangle[count] = static_cast<std::uint32_t>(*index);
      ++count;
    });
    if (count != 3) element.refuse(fmt::format("must be three indices, not {} values", count));
    triangles.push_back(triangle);
  });
  return triangles;
}

}  // namespace raytracer
