// Values that say themselves what they are: {"type": "sphere", ...}.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/scene/fields.h"

namespace raytracer {

/// A table from a "type" to the function that reads the rest.
template <typename T, std::size_t count>
using TypedReaders = std::array<std::pair<std::string_view, T (*)(const Field&)>, count>;

/// Reads an object by the table's row for its "type"; nothing if there is no such row.
template <typename T, std::size_t count>
std::optional<T> read_typed(const Field& field, const TypedReaders<T, count>& readers) {
  if (field.value.kind() != JsonKind::object) {
    const ObjectReader complain(field, {});
    return {};
  }
  const std::optional<JsonValue> value = field.value.member("type");
  const Path path = field.path.child("type");
  if (!value) {
    field.errors.add(ErrorKind::invalid, path, "\"type\" is required");
    return {};
  }
  std::array<std::string_view, count> words;
  std::transform(readers.begin(), readers.end(), words.begin(),
                 [](const auto& row) { return row.first; });
  const std::optional<std::size_t> type = read_choice({*value, path, field.errors}, words);
  if (!type) return {};
  return readers[*type].second(field);
}

}  // namespace raytracer
