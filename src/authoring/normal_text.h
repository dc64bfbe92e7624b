#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// Text normalised for comparison with what must not leak: in lower case, without blanks, line breaks,
/// control characters and comment markers. `lines` has the line, from 1, of each letter.
struct NormalText {
  std::string letters{};
  std::vector<int> lines{};
};

enum class Comments { kKeep, kDrop };

/// Normalises a text, dropping C++ comments or only their markers. Escapes in string literals and the HTML
/// entities for < > & " are decoded.
[[nodiscard]] NormalText normalText(std::string_view text, Comments comments);

}  // namespace rex::grading
