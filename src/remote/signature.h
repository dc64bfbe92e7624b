#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <utility>

#include "remote/aggregate.h"

namespace rex::remote {

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
