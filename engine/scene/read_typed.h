// Values that say themselves what they are: {"type": "sphere", ...}.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "engine/fields/types.h"
#include "engine/scene/fields.h"

namespace raytracer {

/// Reads an object as that of the documents whose `type` it says; nothing if there is none.
/// `also` are keys that all of them may have.
template <typename Variant, typename... Document, std::size_t also_count>
std::optional<Variant> read_typed(const Field& field, Types<Document...>,
                                  const std::array<std::string_view, also_count>& also) {
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
  static constexpr std::array<std::string_view, sizeof...(Document)> words{Document::type...};
  const std::optional<std::size_t> type = read_choice({*value, path, field.errors}, words);
  if (!type) return {};
  std::optional<Variant> read;
  const auto read_as = [&]<typename Type>(std::type_identity<Type>) {
    if (words[*type] != Type::type) return;
    std::array<std::string_view, also_count + 1> others{"type"};
    std::copy(also.begin(), also.end(), others.begin() + 1);
    const ObjectReader object(field, keys_of(Type::fields, others));
    Type document;
    read_fields(object, Type::fields, document);
    read = std::move(document);
  };
  (read_as(std::type_identity<Document>{}), ...);
  return read;
}

}  // namespace raytracer
