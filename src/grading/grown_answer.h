#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace rex::grading {

/// Ways in which an answer could make more room for itself: all of its numbers huge, all of them tiny, one
/// of them huge, or one more entry, row and list element, steep in every number of the question, beside
/// numbers that are one per cent wrong.
enum class Growth { kHuge, kTiny, kOneHuge, kSteep, kCount };

[[nodiscard]] std::string toString(Growth growth);

/// How an answer is changed; the same change of every answer of a function.
struct Change {
  Growth growth = Growth::kHuge;
  /// Whether the same numbers are only made wrong: three times as large, a third, or without the entries.
  bool isPlain = false;
  double place = 0;     ///< of the one huge number among all, from 0 to 1
  double factor = 1e9;  ///< what is huge
};

/// The honest answer, changed. `layouts` are those of the answer and of each argument (remote/layout.h).
/// An answer without such numbers, or of a fixed size, stays as it is. Throws Error if `answer` or
/// `arguments` do not have these layouts.
[[nodiscard]] std::vector<std::byte> grown(std::span<const std::byte> answer,
                                           std::span<const std::byte> arguments,
                                           const std::vector<std::string>& layouts, const Change& change);

}  // namespace rex::grading
