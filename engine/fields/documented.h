// What a document can say: a structure with a table of its fields.
#pragma once

#include <concepts>
#include <string_view>

namespace raytracer {

/// It has a table of its `fields` (field_table.h).
template <class Structure>
concept HasFields = requires {
  Structure::fields;
};

/// One of several that stand at the same place, told apart by `type`; `description` is for people.
template <class Structure>
concept DocumentedType = HasFields<Structure> && requires {
  { Structure::type } -> std::convertible_to<std::string_view>;
  { Structure::description } -> std::convertible_to<std::string_view>;
};

}  // namespace raytracer
