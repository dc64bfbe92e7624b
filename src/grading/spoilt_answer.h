#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/rng.h"

namespace rex::grading {

/// The ways in which an answer is made hostile: all its numbers, lists and matrices at once, or each node in
/// a way of its own (`mixed`).
enum class Hostility {
  kEmpty,
  kHuge,
  kNotANumber,
  kInfinite,
  kOverflowing,
  kDenormal,
  kZero,
  kConstant,
  kRagged,
  kPermuted,
  kShifted,
  kScaled,
  kExtremeIntegers,
  kMixed,
  kCount
};

[[nodiscard]] std::string toString(Hostility hostility);

/// Whether some numbers of the honest answer stay as they are.
[[nodiscard]] bool keepsNumbers(Hostility hostility);

/// An honest answer, spoilt: bytes of the same layout (remote/layout.h). Throws Error where the bytes are not
/// of that layout.
[[nodiscard]] std::vector<std::byte> spoilt(std::span<const std::byte> answer, const std::string& layout,
                                            Hostility hostility, Rng& rng);

/// How many of the bytes the value takes that begins them. Throws Error where none of that layout does.
[[nodiscard]] std::size_t sizeOfValue(std::span<const std::byte> bytes, const std::string& layout);

}  // namespace rex::grading
