#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// Text as it is compared with what must not leak: in lower case, without blanks, line breaks, control
/// characters and the signs around comments. `lines` has the line, from 1, that each letter came from.
struct NormalText {
  std::string letters{};
  std::vector<int> lines{};
};

enum class Comments { kKeep, kDrop };

/// Drops what C++ takes for comments, or only their signs. Escapes of string literals and the entities of
/// HTML for < > & " count as what they stand for.
[[nodiscard]] NormalText normalText(std::string_view text, Comments comments);

}  // namespace rex::grading
