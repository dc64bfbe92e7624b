#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "remote/aggregate.h"
#include "remote/remote.h"
#include "remote/split_rng.h"

namespace rex::remote {

/// The byte layout of a value of type T (see Wire), as a text: a number is `d`, `f`, or `i` or `u` with its
/// size in bytes; a bool `b`, a string `s`, a random generator `r`; a list `[T]`, an optional `?T`, fields
/// `(TU...)`; a matrix `M` with its rows and columns, -1 for any, and the type of its entries: `M3,-1,d`.
template <class T>
struct Layout {
  static std::string text() {
    if constexpr (std::is_same_v<T, bool>) {
      return "b";
    } else if constexpr (std::is_same_v<T, double>) {
      return "d";
    } else if constexpr (std::is_same_v<T, float>) {
      return "f";
    } else if constexpr (std::is_enum_v<T>) {
      return Layout<std::underlying_type_t<T>>::text();
    } else if constexpr (std::is_integral_v<T>) {
      return (std::is_signed_v<T> ? "i" : "u") + std::to_string(sizeof(T));
    } else if constexpr (std::is_same_v<T, std::string>) {
      return "s";
    } else if constexpr (std::is_same_v<T, SplitRng>) {
      return "r";
    } else {
      static_assert(PlainStruct<T>);
      return []<class... Field>(std::type_identity<std::tuple<Field...>>) {
        return "(" + (Layout<Field>::text() + ...) + ")";
      }(std::type_identity<FieldTuple<T>>{});
    }
  }
};

template <>
struct Layout<void> {
  static std::string text() { return ""; }
};

template <class T>
struct Layout<std::vector<T>> {
  static std::string text() { return "[" + Layout<T>::text() + "]"; }
};

template <class T>
struct Layout<std::optional<T>> {
  static std::string text() { return "?" + Layout<T>::text(); }
};

template <class A, class B>
struct Layout<std::pair<A, B>> {
  static std::string text() { return "(" + Layout<A>::text() + Layout<B>::text() + ")"; }
};

template <class T, std::size_t n>
struct Layout<std::array<T, n>> {
  static std::string text() {
    std::string fields;
    for (std::size_t k = 0; k < n; ++k) fields += Layout<T>::text();
    return "(" + fields + ")";
  }
};

template <class S, int rows, int cols, int options, int maxRows, int maxCols>
struct Layout<Eigen::Matrix<S, rows, cols, options, maxRows, maxCols>> {
  static std::string text() {
    return "M" + std::to_string(rows) + "," + std::to_string(cols) + "," + Layout<S>::text();
  }
};

/// The layout of an argument: of what is sent for it; for functions, whether there is one.
template <class T>
struct ArgumentLayout : Layout<typename Remote<T>::Sent> {};
template <class R, class... A>
struct ArgumentLayout<std::function<R(A...)>> : Layout<bool> {};

template <class F>
struct CallLayout;

/// The layouts of a function's return value and then of its arguments, in order.
template <class R, class... A>
struct CallLayout<R(A...)> {
  static std::vector<std::string> texts() {
    return {Layout<std::remove_cvref_t<R>>::text(), ArgumentLayout<std::remove_cvref_t<A>>::text()...};
  }
};

/// FNV-1a over the characters, starting from `hash`.
constexpr std::uint64_t hashText(std::string_view text, std::uint64_t hash = 0xcbf29ce484222325u) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

/// Mixes one more hash into a list of hashes; the order matters.
constexpr std::uint64_t combineHashes(std::uint64_t list, std::uint64_t next) {
  return (list ^ next) * 0x100000001b3u + (next >> 29);
}

namespace detail {

// Both sides are built by the same compiler, which spells a type in only one way.
template <class T>
consteval std::string_view typeName() {
  return __PRETTY_FUNCTION__;
}

template <class T>
struct TypeHash;

template <class... T>
constexpr std::uint64_t hashTypes(std::uint64_t hash) {
  ((hash = combineHashes(hash, TypeHash<T>::value())), ...);
  return hash;
}

template <class T>
struct TypeHash {
  static constexpr std::uint64_t value() {
    const std::uint64_t name = hashText(typeName<T>());
    if constexpr (PlainStruct<T>) {
      return []<class... Field>(std::uint64_t hash, std::type_identity<std::tuple<Field...>>) {
        return hashTypes<Field...>(hash);
      }(name, std::type_identity<FieldTuple<T>>{});
    } else {
      return name;
    }
  }
};

// The hash of a list of structs changes with the fields of the struct.
template <template <class...> class List, class... T>
struct TypeHash<List<T...>> {
  static constexpr std::uint64_t value() { return hashTypes<T...>(hashText(typeName<List<T...>>())); }
};

template <class F>
struct FunctionHash;
template <class R, class... A>
struct FunctionHash<R(A...)> {
  static constexpr std::uint64_t value() {
    return hashTypes<std::remove_cvref_t<R>, std::remove_cvref_t<A>...>(hashText(typeName<R(A...)>()));
  }
};

}  // namespace detail

/// Hash of a function's name, parameter and result types, down to the fields of plain structs. F is a
/// function type such as decltype(::ikStep).
template <class F>
constexpr std::uint64_t functionHash(std::string_view name) {
  return combineHashes(hashText(name), detail::FunctionHash<F>::value());
}

/// The initial hash of a list of functions; combineHashes() adds each functionHash().
inline constexpr std::uint64_t kEmptySignature = hashText("rex remote 1");

}  // namespace rex::remote
