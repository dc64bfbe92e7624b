#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/rng.h"

namespace rex::grading {

/// The ways in which an answer is made hostile: one way for all its numbers, lists and matrices, or a
/// different way for each node (`mixed`).
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

/// Whether some numbers of the honest answer stay unchanged.
[[nodiscard]] bool keepsNumbers(Hostility hostility);

/// The honest answer, spoilt: bytes of the same layout (remote/layout.h). Throws Error if `answer` does not
/// have that layout.
[[nodiscard]] std::vector<std::byte> spoilt(std::span<const std::byte> answer, const std::string& layout,
                                            Hostility hostility, Rng& rng);

}  // namespace rex::grading
