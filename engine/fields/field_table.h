// The documented fields of a structure, in one table: what reads a document, tells its errors,
// makes its canonical bytes and writes its JSON Schema goes through it.
//
//   struct Sphere {
//     Vec3 center;
//     double radius = 0;
//     static constexpr auto fields =
//         std::tuple(required("center", &Sphere::center, PointRule{}),
//                    required("radius", &Sphere::radius, NumberRule{positive}));
//   };
#pragma once

#include <array>
#include <concepts>
#include <string_view>
#include <tuple>

#include "engine/fields/field_rules.h"

namespace raytracer {

/// One field: its key in a document, where its value is kept, and what that may be. One that a
/// document may leave out keeps the value that the structure begins with.
template <typename Owner, typename Value, typename Rule>
struct DocumentedField {
  std::string_view key;
  Value Owner::*member;
  Rule rule;
  bool is_required;
  std::string_view description;  ///< for people; may be empty
};

template <typename Owner, typename Value, typename Rule>
constexpr DocumentedField<Owner, Value, Rule> required(std::string_view key, Value Owner::*member,
                                                       Rule rule,
                                                       std::string_view description = {}) {
  return {key, member, rule, true, description};
}

template <typename Owner, typename Value, typename Rule>
constexpr DocumentedField<Owner, Value, Rule> optional(std::string_view key, Value Owner::*member,
                                                       Rule rule,
                                                       std::string_view description = {}) {
  return {key, member, rule, false, description};
}

/// It has a table of its `fields`.
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

/// Calls visit(field) for each field of a table.
template <typename... Field, typename Visit>
constexpr void for_each_field(const std::tuple<Field...>& table, const Visit& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, table);
}

/// The keys of a table, those of `more` behind them.
template <typename... Field, typename... More>
constexpr auto keys_of(const std::tuple<Field...>& table, More... more) {
  return std::apply(
      [&](const auto&... field) {
        return std::array<std::string_view, sizeof...(Field) + sizeof...(More)>{field.key...,
                                                                                more...};
      },
      table);
}

}  // namespace raytracer
