// Values that say themselves what they are: {"type": "sphere", ...}.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "engine/fields/types.h"
#include "engine/scene/fields.h"

namespace raytracer {

/// Reads an object as that of the structures whose `type` it says; nothing if there is none.
/// What an object of any type may have, with the keys `also`, is what read_others(object) reads.
template <typename Variant, typename... Structure, std::size_t also_count, typename ReadOthers>
std::optional<Variant> read_typed(const Field& field, Types<Structure...>,
                                  const std::array<std::string_view, also_count>& also,
                                  const ReadOthers& read_others) {
  const std::optional<ObjectReader> object = read_object(field);
  if (!object) return {};
  static constexpr std::array<std::string_view, sizeof...(Structure)> words{Structure::type...};
  std::optional<std::size_t> type;
  object->required("type", type, [](const Field& word) { return read_choice(word, words); });
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
