#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace rex::grading {

/// An answer of a student's function, or an argument of it, taken apart by its layout (remote/layout.h).
struct AnswerValue {
  char kind = ' ';                   ///< the first character of its layout
  std::string layout{};              ///< of the whole value
  int size = 0;                      ///< of an integer, in bytes
  std::vector<AnswerValue> parts{};  ///< of fields, lists, optional values and matrices, these by columns
  double number = 0;
  std::uint64_t bits = 0;        ///< of integers and truth values
  std::vector<std::byte> raw{};  ///< of texts and generators
  int rows = 0, cols = 0;
  int fixedRows = -1, fixedCols = -1;
};

/// Throws Error if the bytes are not one value of that layout. An empty layout means no value.
[[nodiscard]] AnswerValue readAnswer(std::span<const std::byte> bytes, const std::string& layout);

[[nodiscard]] std::vector<std::byte> toBytes(const AnswerValue& value);

/// The number of bytes of the value at the beginning of `bytes`. Throws Error if they do not begin with a
/// value of that layout.
[[nodiscard]] std::size_t sizeOfValue(std::span<const std::byte> bytes, const std::string& layout);

/// Calls `run` for each floating-point number of the value, in order.
void forEachNumber(AnswerValue& value, const std::function<void(double&)>& run);

}  // namespace rex::grading
