// A compile-time list of types: how each concept's registry.h names its members.
#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include "raytrace/math/inline.h"

namespace raytrace {

template <class... Types>
struct TypeList {
  static constexpr std::size_t size = sizeof...(Types);
};

/// The list with T at its end.
template <class List, class T>
struct Appended;
template <class... Types, class T>
struct Appended<TypeList<Types...>, T> {
  using type = TypeList<Types..., T>;
};

/// A tuple with one Container<T> for each T of a list.
template <class List, template <class> class Container>
struct TupleOf;
template <class... Types, template <class> class Container>
struct TupleOf<TypeList<Types...>, Container> {
  using type = std::tuple<Container<Types>...>;
};

/// Calls f(std::type_identity<T>{}) for each T of the list, in the list's order.
template <class... Types, class Function>
RAYTRACE_INLINE void for_each_type(TypeList<Types...>, Function&& f) {
  (f(std::type_identity<Types>{}), ...);
}

/// f(std::type_identity<T>{}) of the T at a position that the list has.
template <class First, class... Others, class Function>
auto with_type(TypeList<First, Others...>, std::size_t position, const Function& f) {
  if constexpr (sizeof...(Others) > 0)
    if (position > 0) return with_type(TypeList<Others...>{}, position - 1, f);
  return f(std::type_identity<First>{});
}

/// Whether the list has T.
template <class T, class... Types>
constexpr bool has_type(TypeList<Types...>) {
  return (std::is_same_v<T, Types> || ...);
}

/// The position of T in the list.
template <class T, class... Types>
constexpr std::size_t index_of(TypeList<Types...>) {
  constexpr bool same[] = {std::is_same_v<T, Types>...};
  std::size_t i = 0;
  while (!same[i]) ++i;
  return i;
}

}  // namespace raytrace
