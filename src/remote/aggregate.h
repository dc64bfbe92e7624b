#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace rex::remote {

/// A plain struct without constructors or base classes, such as `struct TaskValue { VectorXd y; MatrixXd J;
/// }`.
template <class T>
concept PlainStruct = std::is_aggregate_v<T> && !std::is_array_v<T> && !std::is_empty_v<T> && !requires {
  std::tuple_size<T>::value;
};  // std::array is a list, not a struct

namespace detail {

template <class T>
consteval std::size_t countFields() {
  if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; })
    return 10;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}}; })
    return 9;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}}; })
    return 8;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}}; })
    return 7;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}}; })
    return 6;
  else if constexpr (requires { T{{}, {}, {}, {}, {}}; })
    return 5;
  else if constexpr (requires { T{{}, {}, {}, {}}; })
    return 4;
  else if constexpr (requires { T{{}, {}, {}}; })
    return 3;
  else if constexpr (requires { T{{}, {}}; })
    return 2;
  else
    return 1;
}

}  // namespace detail

/// The number of fields of T, or 10 for more than nine, found from how many initialisers it accepts. Each
/// field's type must have a non-explicit default constructor.
template <PlainStruct T>
inline constexpr std::size_t kFieldCount = detail::countFields<T>();

/// Calls use(field, field, ...) with references to all fields of a struct of one to nine fields.
template <class T, class Use>
constexpr decltype(auto) withFields(T& value, Use&& use) {
  constexpr std::size_t n = kFieldCount<std::remove_const_t<T>>;
  static_assert(n <= 9, "a struct that crosses to the worker has 1 to 9 fields");
  if constexpr (n == 1) {
    auto& [a] = value;
    return use(a);
  } else if constexpr (n == 2) {
    auto& [a, b] = value;
    return use(a, b);
  } else if constexpr (n == 3) {
    auto& [a, b, c] = value;
    return use(a, b, c);
  } else if constexpr (n == 4) {
    auto& [a, b, c, d] = value;
    return use(a, b, c, d);
  } else if constexpr (n == 5) {
    auto& [a, b, c, d, e] = value;
    return use(a, b, c, d, e);
  } else if constexpr (n == 6) {
    auto& [a, b, c, d, e, f] = value;
    return use(a, b, c, d, e, f);
  } else if constexpr (n == 7) {
    auto& [a, b, c, d, e, f, g] = value;
    return use(a, b, c, d, e, f, g);
  } else if constexpr (n == 8) {
    auto& [a, b, c, d, e, f, g, h] = value;
    return use(a, b, c, d, e, f, g, h);
  } else {
    auto& [a, b, c, d, e, f, g, h, i] = value;
    return use(a, b, c, d, e, f, g, h, i);
  }
}

namespace detail {

template <class T>
struct FieldTypes {
  static auto list(T& value) {
    return withFields(value, [](auto&... field) {
      return std::type_identity<std::tuple<std::remove_cvref_t<decltype(field)>...>>{};
    });
  }
  using Tuple = typename decltype(list(std::declval<T&>()))::type;
};

}  // namespace detail

/// std::tuple of the field types of T.
template <PlainStruct T>
using FieldTuple = typename detail::FieldTypes<T>::Tuple;

}  // namespace rex::remote
