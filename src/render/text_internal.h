#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rex::internal {

/// The characters of UTF-8 text; each byte that is not part of a valid character becomes U+FFFD.
[[nodiscard]] std::u32string charactersOf(std::string_view text);

/// `text` as valid UTF-8 on one line: what isInvisible() becomes spaces, invalid bytes '?'.
[[nodiscard]] std::string singleLine(std::string_view text);

/// The lines of `text`, which lie between its '\n'; at least one.
[[nodiscard]] std::vector<std::string_view> linesOf(std::string_view text);

/// `text` with each of its lines as of singleLine().
[[nodiscard]] std::string singleLines(std::string_view text);

}  // namespace rex::internal
