// Lists of types: the kinds of something, or the structures that say them in a document.
#pragma once

#include <cstddef>
#include <type_traits>

namespace raytracer {

template <typename... T>
struct Types {
  static constexpr std::size_t count = sizeof...(T);

  /// Calls visit(std::type_identity<T>()) for each.
  template <typename Visit>
  static constexpr void for_each(const Visit& visit) {
    (visit(std::type_identity<T>{}), ...);
  }

  template <typename Wanted>
  static constexpr bool has = (std::is_same_v<T, Wanted> || ...);

  /// The place of a type among them.
  template <typename Wanted>
  static constexpr std::size_t index_of() {
    constexpr bool is_wanted[] = {std::is_same_v<T, Wanted>...};
    std::size_t index = 0;
    while (!is_wanted[index]) ++index;
    return index;
  }

  /// Target<T...>
  template <template <typename...> typename Target>
  using In = Target<T...>;
};

/// Does not compile, and the compiler names what is missing, unless each type of a list satisfies
/// the concept that `check` asks for: a lambda []<Concept T>(std::type_identity<T>) {}.
template <class List, class Check>
constexpr bool each_satisfies(const Check& check) {
  List::for_each(check);
  return true;
}

/// The types of several lists, one behind the other.
template <typename... List>
struct Joined;
template <typename... T>
struct Joined<Types<T...>> {
  using All = Types<T...>;
};
template <typename... A, typename... B, typename... Rest>
struct Joined<Types<A...>, Types<B...>, Rest...> {
  using All = typename Joined<Types<A..., B...>, Rest...>::All;
};

}  // namespace raytracer
