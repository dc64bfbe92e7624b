#pragma once
// Values as bytes between grader and worker, and back.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "remote/aggregate.h"
#include "remote/split_rng.h"

namespace rex::remote {

/// The other side sent something that no correct peer would send.
class ProtocolError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Collects the bytes of one message, in the machine's own byte order: both sides run on one machine.
class Writer {
 public:
  void raw(const void* data, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
  }
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

/// Limits that the numbers in an answer of a student's function must keep before anything computes with
/// them.
struct AnswerLimits {
  bool any = false;          ///< all numbers are allowed
  bool infinite = false;     ///< infinite numbers are allowed
  double magnitude = 1e100;  ///< limit for finite numbers: their squares and cubes are finite, too
};

/// A student's function returned numbers outside the limits.
class AnswerRefused : public std::exception {
 public:
  AnswerRefused(std::string function, std::string why)
      : function_(std::move(function)), why_(std::move(why)) {}
  const char* what() const noexcept override { return why_.c_str(); }
  const std::string& function() const { return function_; }

 private:
  std::string function_, why_;
};

/// Parses the bytes of one message. Trusts nothing: every size is compared with the remaining bytes before
/// anything is allocated. Does not own the bytes.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::size_t left() const { return bytes_.size(); }
  std::span<const std::byte> bytes() const { return bytes_; }

  /// From now on numbers() throws AnswerRefused naming `function` for numbers outside the limits. Both
  /// arguments must outlive the reader.
  void limitTo(const AnswerLimits& limits, const std::string& function) {
    limits_ = &limits;
    function_ = &function;
  }

  /// Called with all floating-point numbers that are read; checks them if there are limits.
  void numbers(const double* first, std::size_t count) {
    if (limits_ != nullptr) examine(first, count);
  }
  void numbers(const float* first, std::size_t count) {
    for (const float* one = first; one != first + count; ++one) {
      const double number = *one;
      numbers(&number, 1);
    }
  }

  /// Copies the next `size` bytes. Throws ProtocolError if there are fewer.
  void raw(void* to, std::size_t size) {
    if (size > bytes_.size()) throw ProtocolError("the message ends too early");
    if (size > 0) std::memcpy(to, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }

  /// Reads the length of a list whose elements take at least one byte each. Throws ProtocolError if it
  /// exceeds the remaining bytes.
  std::size_t count() {
    std::uint64_t n = 0;
    raw(&n, sizeof n);
    if (n > bytes_.size()) throw ProtocolError("a list is longer than its message");
    return n;
  }

  /// Throws ProtocolError if bytes are left over.
  void expectEnd() const {
    if (!bytes_.empty()) throw ProtocolError("the message is longer than its content");
  }

 private:
  void examine(const double* first, std::size_t count);

  std::span<const std::byte> bytes_;
  const AnswerLimits* limits_ = nullptr;
  const std::string* function_ = nullptr;
  std::size_t examined_ = 0;
};

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
    if constexpr (std::is_floating_point_v<T>) reader.numbers(&value, 1);
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
    if constexpr (std::is_floating_point_v<S>) reader.numbers(matrix.data(), coefficients);
    return matrix;
  }

 private:
  static bool fits(std::int32_t size, int fixed, int max) {
    return size >= 0 && (fixed == Eigen::Dynamic || size == fixed) && (max == Eigen::Dynamic || size <= max);
  }
};

/// Sent with its position in the sequence, so that both sides draw the same numbers.
template <>
struct Wire<SplitRng> {
  using State = std::array<std::uint64_t, 4>;
  static void put(Writer& writer, const SplitRng& rng) { Wire<State>::put(writer, rng.state()); }
  static SplitRng get(Reader& reader) {
    const State state = Wire<State>::get(reader);
    if (state == State{}) throw ProtocolError("a random generator has an empty state");
    return {SplitRng::Received(), Rng::fromState(state)};
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
