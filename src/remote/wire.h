#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "base/rng.h"
#include "remote/aggregate.h"
#include "remote/bytes.h"

namespace rex::remote {

/// Serialises a value of type T: `put` appends it, and `get` reads it back and throws ProtocolError for
/// bytes that no value produces. Types without a specialisation cannot be sent.
template <class T>
struct Wire;

template <class T>
concept PlainNumber = (std::is_integral_v<T> && !std::is_same_v<T, bool>) || std::is_same_v<T, float> ||
                      std::is_same_v<T, double>;

template <PlainNumber T>
struct Wire<T> {
  static void put(Writer& writer, T value) { writer.raw(&value, sizeof value); }
  static T get(Reader& reader) {
    T value{};
    reader.raw(&value, sizeof value);
    if constexpr (std::is_same_v<T, double>) reader.numbers(&value, 1);
    return value;
  }
};

template <>
struct Wire<bool> {
  static void put(Writer& writer, bool value) { Wire<std::uint8_t>::put(writer, value ? 1 : 0); }
  static bool get(Reader& reader) {
    const std::uint8_t value = Wire<std::uint8_t>::get(reader);
    if (value > 1) throw ProtocolError("a truth value is neither 0 nor 1");
    return value == 1;
  }
};

/// An enum may come back with a value that has no name; its users must expect that.
template <class T>
requires std::is_enum_v<T>
struct Wire<T> {
  using Number = std::underlying_type_t<T>;
  static void put(Writer& writer, T value) { Wire<Number>::put(writer, static_cast<Number>(value)); }
  static T get(Reader& reader) { return static_cast<T>(Wire<Number>::get(reader)); }
};

template <>
struct Wire<std::string> {
  static void put(Writer& writer, const std::string& text) {
    Wire<std::uint64_t>::put(writer, text.size());
    writer.raw(text.data(), text.size());
  }
  static std::string get(Reader& reader) {
    std::string text(reader.count(), '\0');
    reader.raw(text.data(), text.size());
    return text;
  }
};

template <class T>
struct Wire<std::vector<T>> {
  static void put(Writer& writer, const std::vector<T>& list) {
    Wire<std::uint64_t>::put(writer, list.size());
    for (const T& element : list) Wire<T>::put(writer, element);
  }
  // Grows while reading: a lying length costs no memory that was not sent.
  static std::vector<T> get(Reader& reader) {
    std::vector<T> list;
    for (std::size_t left = reader.count(); left > 0; --left) list.push_back(Wire<T>::get(reader));
    return list;
  }
};

template <class T, std::size_t n>
struct Wire<std::array<T, n>> {
  static void put(Writer& writer, const std::array<T, n>& list) {
    for (const T& element : list) Wire<T>::put(writer, element);
  }
  static std::array<T, n> get(Reader& reader) {
    std::array<T, n> list{};
    for (T& element : list) element = Wire<T>::get(reader);
    return list;
  }
};

template <class A, class B>
struct Wire<std::pair<A, B>> {
  static void put(Writer& writer, const std::pair<A, B>& pair) {
    Wire<A>::put(writer, pair.first);
    Wire<B>::put(writer, pair.second);
  }
  static std::pair<A, B> get(Reader& reader) {
    A first = Wire<A>::get(reader);
    B second = Wire<B>::get(reader);
    return {std::move(first), std::move(second)};
  }
};

template <class T>
struct Wire<std::optional<T>> {
  static void put(Writer& writer, const std::optional<T>& value) {
    Wire<bool>::put(writer, value.has_value());
    if (value) Wire<T>::put(writer, *value);
  }
  static std::optional<T> get(Reader& reader) {
    if (!Wire<bool>::get(reader)) return std::nullopt;
    return Wire<T>::get(reader);
  }
};

/// Rows and columns as 32-bit numbers, then the coefficients in memory order.
template <PlainNumber S, int rows, int cols, int options, int maxRows, int maxCols>
struct Wire<Eigen::Matrix<S, rows, cols, options, maxRows, maxCols>> {
  using Matrix = Eigen::Matrix<S, rows, cols, options, maxRows, maxCols>;

  static void put(Writer& writer, const Matrix& matrix) {
    Wire<std::int32_t>::put(writer, static_cast<std::int32_t>(matrix.rows()));
    Wire<std::int32_t>::put(writer, static_cast<std::int32_t>(matrix.cols()));
    writer.raw(matrix.data(), sizeof(S) * static_cast<std::size_t>(matrix.size()));
  }
  static Matrix get(Reader& reader) {
    const std::int32_t r = Wire<std::int32_t>::get(reader);
    const std::int32_t c = Wire<std::int32_t>::get(reader);
    if (!fits(r, rows, maxRows) || !fits(c, cols, maxCols))
      throw ProtocolError("a matrix has a size that its type cannot have");
    const std::uint64_t coefficients = static_cast<std::uint64_t>(r) * static_cast<std::uint64_t>(c);
    if (coefficients > reader.left() / sizeof(S)) throw ProtocolError("a matrix is larger than its message");
    Matrix matrix;
    matrix.resize(r, c);
    reader.raw(matrix.data(), sizeof(S) * coefficients);
    if constexpr (std::is_same_v<S, double>) reader.numbers(matrix.data(), coefficients);
    return matrix;
  }

 private:
  static bool fits(std::int32_t size, int fixed, int max) {
    return size >= 0 && (fixed == Eigen::Dynamic || size == fixed) && (max == Eigen::Dynamic || size <= max);
  }
};

/// Sent with its position in the sequence, so that both sides draw the same numbers.
template <>
struct Wire<Rng> {
  using State = std::array<std::uint64_t, 4>;
  static void put(Writer& writer, const Rng& rng) { Wire<State>::put(writer, rng.state()); }
  static Rng get(Reader& reader) {
    const State state = Wire<State>::get(reader);
    if (state == State{}) throw ProtocolError("a random generator has an empty state");
    return Rng::fromState(state);
  }
};

template <PlainStruct T>
struct Wire<T> {
  static void put(Writer& writer, const T& value) {
    withFields(value, [&](const auto&... field) {
      (Wire<std::remove_cvref_t<decltype(field)>>::put(writer, field), ...);
    });
  }
  static T get(Reader& reader) {
    T value{};
    withFields(value, [&](auto&... field) {
      ((field = Wire<std::remove_cvref_t<decltype(field)>>::get(reader)), ...);
    });
    return value;
  }
};

}  // namespace rex::remote
