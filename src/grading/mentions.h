#pragma once

#include <string_view>
#include <utility>

namespace rex::grading {

/// Line and column, from 1, of the only place outside comments, literals and the body of main() where a C++
/// source names the function, by the last part of its qualified name; 0, 0 when there is none or several.
[[nodiscard]] std::pair<int, int> onlyMentionOf(std::string_view function, std::string_view source);

}  // namespace rex::grading
